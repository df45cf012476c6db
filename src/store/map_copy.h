// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "store/database.h"

namespace sslcd {

/// Replaces the content of a database by that of another one, in one transaction (SQLite's backup):
/// readers see the old or the new content, a crash leaves the old one. Throws as Database does.
void CopyDatabase(const Database& from, Database& to);

/// A copy of a map beside a file, to work in while nobody else sees it: FILE-merge. Needs the
/// lock of FILE (LockMap). Removes what a killed process has left of such a copy, and the copy at
/// the end.
class WorkingCopy {
 public:
  static std::string PathBeside(const std::string& file);  ///< FILE-merge
  WorkingCopy(const std::string& map, const std::string& file);
  ~WorkingCopy();
  WorkingCopy(const WorkingCopy&) = delete;
  WorkingCopy& operator=(const WorkingCopy&) = delete;

  const std::string& path() const { return path_; }
  /// Writes the copy's content into a map that exists.
  void WriteInto(const std::string& map) const;
  /// Renames the copy, which must be closed. Throws Error(kOutput), also if part of its content is
  /// still in SQLite's log.
  void MoveTo(const std::string& file);

 private:
  void Remove() const;
  std::string path_;
};

}  // namespace sslcd
