// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sslcd/core/layout.h"
#include "sslcd/loop/options.h"

namespace sslcd {

/// Log likelihood ratio of "the same object" against "different objects" by all cues: the
/// properties of paper IV-C as evidence instead of a gate. Zero if nothing can be compared. Takes
/// the symmetry of the objects into account when it compares the bearings of views. O(views of a *
/// views of b * length).
double AppearanceGain(const LayoutObject& a, const LayoutObject& b,
                      const AppearanceOptions& options);

}  // namespace sslcd
