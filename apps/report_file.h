// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "report/run_view.h"

namespace sslcd::apps {

/// The page of a run folder, if no other place is named.
std::string PagePath(const std::string& run);

/// A page to write.
struct PageRequest {
  std::vector<std::string> runs;  ///< run folders
  std::string groundtruth;        ///< see ReadRun
  std::string out;                ///< file to write
  std::string option = "--out";   ///< the one that names it, for messages
  std::vector<std::string> read;  ///< other files that the command reads
  bool images = true;             ///< with crops of the matched objects, see AddLoopImages
  std::string metrics;            ///< JSON, instead of that of the folders; empty: theirs
};

/// Throws Error(kUsage) if the page would replace a file that is read: ground truth, a file of a
/// run, or one of the inputs that a run lists.
void RefusePage(const PageRequest& page);

/// Writes a page that shows the run folders, and returns what it has read of them. Throws Error as
/// RefusePage does, if a run cannot be read, if the libraries of the page were not built in, or if
/// it cannot be written.
std::vector<RunView> WriteReport(const PageRequest& page);

}  // namespace sslcd::apps
