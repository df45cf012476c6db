// SPDX-License-Identifier: BSD-3-Clause
#include "formats/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include "core/command_line.h"
#include "core/utc_time.h"
#include "formats/atomic_file.h"
#include "formats/files.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

constexpr std::size_t kMostOfCommand = 200;  // what a message shows of it

std::string HostName() {
  char name[256] = "";
  if (gethostname(name, sizeof name - 1) != 0) return "unknown";
  return name;
}

std::string Holder() {
  std::string command = CommandLine(CommandWords());
  if (command.size() > kMostOfCommand) command = command.substr(0, kMostOfCommand) + "...";
  return "process " + std::to_string(getpid()) + " on " + HostName() + " since " + UtcTime() +
         (command.empty() ? "" : " (" + command + ")");
}

std::string ContentOf(int file) {
  char text[1024];
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

int Open(const std::string& path) {
  int file = -1;
  do file = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
  while (file < 0 && errno == EINTR);
  return file;
}

void WriteHolder(int file, const std::string& holder) {
  // for people only: the lock holds without it
  if (ftruncate(file, 0) == 0 && pwrite(file, holder.data(), holder.size(), 0) < 0) return;
}

}  // namespace

FileLock::FileLock(const std::string& path, const std::string& what, const std::string& way_out,
                   WithoutLocks without)
    : path_(path), holder_(getpid()) {
  const std::string holder = Holder();  // may throw, which it must not do while the file is open
  while (true) {
    file_ = Open(path_);
    if (file_ < 0)
      throw Error(ErrorKind::kOutput,
                  path_ + ": cannot be made, which a writer needs: " + std::strerror(errno) +
                      "; its folder must exist and be writable");
    if (flock(file_, LOCK_EX | LOCK_NB) != 0) {
      const int code = errno;
      if (code != EWOULDBLOCK && without == WithoutLocks::kGoOn) break;
      const std::string other = ContentOf(file_);
      close(file_);
      throw Error(ErrorKind::kOutput, code == EWOULDBLOCK
                                          ? what + ": is being written by " + other + "; " + way_out
                                          : path_ + ": cannot be locked: " + std::strerror(code) +
                                                "; choose a folder on a local disk");
    }
    if (IsAt(file_, path_)) break;
    close(file_);
  }
  WriteHolder(file_, holder);
}

FileLock::FileLock(FileLock&& other) noexcept
    : path_(std::move(other.path_)),
      file_(std::exchange(other.file_, -1)),
      holder_(other.holder_) {}

FileLock::~FileLock() {
  if (file_ < 0) return;
  if (getpid() == holder_) unlink(path_.c_str());  // while it is held
  close(file_);
}

FileLock LockFolder(const std::string& folder) {
  MakeWritableFolder(folder);
  return FileLock((std::filesystem::path(folder) / kFolderLock).string(), folder,
                  "wait until it has ended, or write into another folder", WithoutLocks::kGoOn);
}

bool IsEmptyFolder(const std::string& folder) {
  if (access(folder.c_str(), R_OK) != 0)
    throw Error(ErrorKind::kOutput,
                folder + ": " + std::strerror(errno) + "; choose another folder");
  const std::vector<std::string> names = FileNames(folder);
  return std::all_of(names.begin(), names.end(),
                     [](const std::string& name) { return name == kFolderLock; });
}

}  // namespace sslcd
