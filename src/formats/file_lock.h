// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "sslcd/core/export.h"

namespace sslcd {

/// What to do on a file system that has no locks.
enum class WithoutLocks { kFail, kGoOn };

/// The right to write, which one process at a time has: it holds a lock (flock) on a file that
/// names it. The system frees the lock when the process and the children it has forked end,
/// however that happens, and the next one takes its file over. The file is removed when the right
/// is given back. Readers need none.
class SSLCD_EXPORT FileLock {
 public:
  /// `path` is the file to lock, `what` it protects. Throws Error(kOutput): "WHAT: is being written
  /// by process 7 on HOST since TIME (COMMAND); WAY_OUT", or the reason why it cannot be locked.
  FileLock(const std::string& path, const std::string& what, const std::string& way_out,
           WithoutLocks without = WithoutLocks::kFail);
  ~FileLock();
  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&&) = delete;

 private:
  std::string path_;
  int file_ = -1;
  int holder_ = 0;  // the process: a child that it forks gives nothing back
};

/// The file that a process holds while it writes into a folder.
inline constexpr const char* kFolderLock = ".sslcd-lock";

/// Creates the folder if necessary (MakeWritableFolder), and locks it.
[[nodiscard]] FileLock LockFolder(const std::string& folder);

/// Nothing is in the folder but the lock of a process that prepares to write. Throws Error(kOutput)
/// if the folder cannot be read.
bool IsEmptyFolder(const std::string& folder);

}  // namespace sslcd
