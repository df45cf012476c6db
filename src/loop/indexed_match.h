// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "loop/layout_index.h"
#include "sslcd/core/layout.h"
#include "sslcd/loop/layout_match.h"
#include "sslcd/loop/options.h"

namespace sslcd {

/// MatchLayouts in a map that is searched more than once. Matches are indices into
/// `index.objects()`.
LayoutAnswer MatchLayouts(const std::vector<LayoutObject>& local, const LayoutIndex& index,
                          const LayoutMatchOptions& options = {},
                          const SingleLookOptions& decision = {});

}  // namespace sslcd
