// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace sslcd {

/// Files that belong together: readers take them all, or none.
struct FileSet {
  std::string folder;  ///< which is there
  std::string name;    ///< of the set; a folder may have several
  std::vector<std::pair<std::string, std::string>> files;  ///< path, content
  /// paths of files that an earlier call may have written and that would not belong to these
  std::vector<std::string> removed;
};

/// Replaces a set as WriteFilesAtomically does. As long as files of two calls may be there, also
/// after the program was killed, the folder holds `.sslcd-unfinished-NAME`. Throws Error(kOutput).
void WriteFileSet(FileSet set);

/// Throws Error(kBadInput) if the folder holds such a mark. People may delete it, and may change
/// the files.
void RefuseUnfinished(const std::string& folder);

}  // namespace sslcd
