// SPDX-License-Identifier: BSD-3-Clause
#include "formats/atomic_file.h"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <set>
#include <utility>

#include "formats/files.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void Fail(const std::string& path, int code, const std::string& way_out) {
  throw Error(ErrorKind::kOutput,
              path + ": cannot be written: " + std::strerror(code) + "; " + way_out);
}

constexpr int kNew = O_CREAT | O_EXCL | O_NOFOLLOW;  // a file that was not there before

// 0 or errno. A file system that has no such call is no failure.
int Synchronise(int file) {
  while (fsync(file) != 0) {
    if (errno == EINVAL || errno == ENOSYS || errno == ENOTSUP) return 0;
    if (errno != EINTR) return errno;
  }
  return 0;
}

// Makes names in a folder last. A folder that may not be read cannot be synchronised.
int SynchroniseFolder(const fs::path& folder) {
  const int file = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file < 0) return 0;
  const int code = Synchronise(file);
  close(file);
  return code;
}

fs::path FolderOf(const std::string& path) { return fs::absolute(path).parent_path(); }

// 0, or errno of the first step that failed.
int WriteAll(const std::string& path, const std::string& content, int flags,
             Durability durability) {
  int file = -1, code = 0;
  do file = open(path.c_str(), flags | O_WRONLY | O_CLOEXEC, 0666);
  while (file < 0 && errno == EINTR);
  if (file < 0) return errno;
  for (std::size_t done = 0; done < content.size() && code == 0;) {
    const ssize_t written = write(file, content.data() + done, content.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0)
      code = errno;
    else
      done += static_cast<std::size_t>(written);
  }
  if (code == 0 && durability == Durability::kSynced) code = Synchronise(file);
  if (close(file) != 0 && errno != EINTR && code == 0) code = errno;  // it is closed all the same
  return code;
}

const std::string kTemporary = ".tmp-";

std::string TemporaryName(const std::string& path) {
  return path + kTemporary + std::to_string(getpid());
}

// Removes what killed programs have left of a file: PATH.tmp-PID of a process that is no more.
void RemoveLitter(const std::string& path) {
  const std::string name = fs::path(path).filename().string() + kTemporary;
  const fs::path folder = FolderOf(path);
  for (const std::string& other : FileNames(folder.string())) {
    if (other.rfind(name, 0) != 0) continue;
    pid_t process = 0;
    const char* const end = other.data() + other.size();
    const auto [last, error] = std::from_chars(other.data() + name.size(), end, process);
    if (error != std::errc() || last != end || process <= 0) continue;
    const bool ends = process == getpid() || (kill(process, 0) != 0 && errno == ESRCH);
    if (ends) unlink((folder / other).c_str());
  }
}

// Files under temporary names, with their final ones. Removes those that were not renamed, also
// when memory is short.
struct Temporaries {
  std::vector<std::pair<std::string, std::string>> names;
  Temporaries() = default;
  Temporaries(const Temporaries&) = delete;
  Temporaries& operator=(const Temporaries&) = delete;
  ~Temporaries() {
    for (const auto& [name, final_name] : names) unlink(name.c_str());
  }
};

}  // namespace

void RequirePlaceOf(const std::string& path) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) Fail(path, EISDIR, "name a file");
  const fs::path folder = fs::path(path).parent_path();
  if (!folder.empty() && !fs::is_directory(folder, ignored))
    Fail(path, ENOENT, "choose another folder");
}

void WriteFileAtomically(const std::string& path, const std::string& content,
                         Durability durability) {
  WriteFilesAtomically({{path, content}}, durability);
}

void WriteFilesAtomically(const std::vector<std::pair<std::string, std::string>>& files,
                          Durability durability) {
  std::error_code ignored;
  for (const auto& [path, content] : files)
    if (fs::is_directory(path, ignored)) Fail(path, EISDIR, "name a file");
  Temporaries waiting;
  waiting.names.reserve(files.size());
  for (const auto& [path, content] : files) {
    const fs::file_status status = fs::status(path, ignored);
    const bool special = fs::exists(status) && !fs::is_regular_file(status);
    const std::string temporary = TemporaryName(path);
    int code = 0;
    if (special) {
      code = WriteAll(path, content, 0, Durability::kUnsynced);
    } else {
      RemoveLitter(path);
      std::pair<std::string, std::string> names(temporary, path);
      code = WriteAll(temporary, content, kNew, durability);
      if (code != EEXIST) waiting.names.push_back(std::move(names));
    }
    if (code == 0) continue;
    if (special) Fail(path, code, "name another file");
    Fail(path, code,
         code == ENOSPC ? "make room or choose another folder" : "choose another folder");
  }
  std::set<fs::path> folders;
  for (const auto& [temporary, path] : waiting.names) {
    if (durability == Durability::kSynced) folders.insert(FolderOf(path));
    if (std::rename(temporary.c_str(), path.c_str()) == 0) continue;
    const int code = errno;
    Fail(path, code, "choose another folder");
  }
  waiting.names.clear();
  for (const fs::path& folder : folders)
    if (const int code = SynchroniseFolder(folder)) Fail(folder.string(), code, "check the disk");
}

void MakeWritableFolder(const std::string& path) {
  std::error_code code, unseen;
  std::vector<fs::path> parents;  // of folders that are not there yet
  for (fs::path folder = fs::absolute(path);
       !fs::exists(folder, unseen) && folder.has_relative_path(); folder = folder.parent_path())
    parents.push_back(folder.parent_path());
  fs::create_directories(path, code);
  if (!fs::is_directory(path, unseen))
    Fail(path, code ? code.value() : unseen ? unseen.value() : ENOTDIR, "choose another folder");
  for (const fs::path& parent : parents)
    if (const int failed = SynchroniseFolder(parent))
      Fail(parent.string(), failed, "check the disk");
  const std::string probe = TemporaryName(fs::path(path) / ".sslcd-probe");
  RemoveLitter(fs::path(path) / ".sslcd-probe");
  int failed = WriteAll(probe, "", kNew, Durability::kUnsynced);
  if (failed != EEXIST && unlink(probe.c_str()) != 0 && failed == 0) failed = errno;
  if (failed != 0) Fail(path, failed, "choose another folder");
}

}  // namespace sslcd
