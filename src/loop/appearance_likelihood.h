// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sslcd/core/layout.h"
#include "sslcd/loop/options.h"

namespace sslcd {

/// Log likelihood ratio of "one object" to "two objects" by all cues, paper IV-C's properties as
/// evidence and never as a gate. Zero where nothing can be compared. Bearings of
/// views are compared as far as the symmetry of the objects allows. O(views of a * views of b *
/// length).
double AppearanceGain(const LayoutObject& a, const LayoutObject& b,
                      const AppearanceOptions& options);

}  // namespace sslcd
