// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "report/run_view.h"

namespace sslcd::apps {

/// Writes a page that shows the run folders, and returns what it has read of them. `groundtruth`:
/// see ReadRun; `images`: with crops of the matched objects, see AddLoopImages; `metrics`: JSON
/// instead of that of the folders. Throws Error if a run cannot be read, if the libraries of the
/// page were not built in, or if it cannot be written.
std::vector<RunView> WriteReport(const std::vector<std::string>& runs,
                                 const std::string& groundtruth, const std::string& out,
                                 bool images = true, const std::string& metrics = "");

}  // namespace sslcd::apps
