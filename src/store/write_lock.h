// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace sslcd {

/// The right to write to a store: one process at a time holds PATH-lock (flock), which ends with
/// the process, however that ends. Readers need none. Throws Error(kOutput) that names the holder,
/// or the reason why the lock file cannot be made.
class WriteLock {
 public:
  explicit WriteLock(const std::string& path);
  ~WriteLock();
  WriteLock(WriteLock&& other) noexcept;
  WriteLock& operator=(WriteLock&&) = delete;

 private:
  std::string lock_path_;
  int file_ = -1;
};

}  // namespace sslcd
