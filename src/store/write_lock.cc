// SPDX-License-Identifier: BSD-3-Clause
#include "store/write_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "core/utc_time.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

std::string HostName() {
  char name[256] = "";
  if (gethostname(name, sizeof name - 1) != 0) return "unknown";
  return name;
}

std::string ContentOf(int file) {
  char text[512];
  const ssize_t size = pread(file, text, sizeof text, 0);
  return size > 0 ? std::string(text, static_cast<std::size_t>(size)) : "another process";
}

// The holder removes its file, so another process may have opened one that is no longer there.
bool IsAt(int file, const std::string& path) {
  struct stat open_file {
  }, named{};
  return fstat(file, &open_file) == 0 && stat(path.c_str(), &named) == 0 &&
         open_file.st_ino == named.st_ino && open_file.st_dev == named.st_dev;
}

void WriteHolder(int file) {
  const std::string holder =
      "process " + std::to_string(getpid()) + " on " + HostName() + " since " + UtcTime();
  // for people only: the lock holds without it
  if (ftruncate(file, 0) == 0 && pwrite(file, holder.data(), holder.size(), 0) < 0) return;
}

}  // namespace

WriteLock::WriteLock(const std::string& path) : lock_path_(path + "-lock") {
  while (true) {
    file_ = open(lock_path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (file_ < 0)
      throw Error(ErrorKind::kOutput,
                  lock_path_ + ": cannot be made, which a writer needs: " + std::strerror(errno) +
                      "; the folder of the map must exist and be writable");
    if (flock(file_, LOCK_EX | LOCK_NB) != 0) {
      const std::string holder = ContentOf(file_);
      close(file_);
      throw Error(ErrorKind::kOutput, path + ": is being written by " + holder +
                                          "; wait until it has ended. Reading is possible at any "
                                          "time");
    }
    if (IsAt(file_, lock_path_)) break;
    close(file_);
  }
  WriteHolder(file_);
}

WriteLock::WriteLock(WriteLock&& other) noexcept
    : lock_path_(std::move(other.lock_path_)), file_(std::exchange(other.file_, -1)) {}

WriteLock::~WriteLock() {
  if (file_ < 0) return;
  unlink(lock_path_.c_str());  // while it is held
  close(file_);
}

}  // namespace sslcd
