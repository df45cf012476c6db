// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "report/run_view.h"

namespace sslcd {

/// What a report shows at most of each run. Longer runs are thinned evenly, and the report says so.
struct ReportLimits {
  std::size_t poses = 50000, objects = 20000, attempts = 20000;
};

/// Returns the data of a report as JSON that may stand in a page as it is: '<' is escaped.
/// Positions are whole millimetres from the first camera, x right and z towards the viewer of a
/// map, y up (the axes of three.js). `names` are those of the runs, in the same order.
std::string ReportJson(const std::vector<RunView>& runs, const std::vector<std::string>& names,
                       const ReportLimits& limits = {});

}  // namespace sslcd
