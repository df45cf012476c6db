// SPDX-License-Identifier: BSD-3-Clause
#include "formats/atomic_file.h"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>

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

// 0, or errno of the first step that failed.
int WriteAll(const std::string& path, const std::string& content, int flags) {
  const int file = open(path.c_str(), flags | O_WRONLY | O_CLOEXEC, 0666);
  if (file < 0) return errno;
  int code = 0;
  for (std::size_t done = 0; done < content.size() && code == 0;) {
    const ssize_t written = write(file, content.data() + done, content.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0)
      code = errno;
    else
      done += static_cast<std::size_t>(written);
  }
  if (close(file) != 0 && code == 0) code = errno;
  return code;
}

const std::string kTemporary = ".tmp-";

std::string TemporaryName(const std::string& path) {
  return path + kTemporary + std::to_string(getpid());
}

// Removes what killed programs have left of a file: PATH.tmp-PID of a process that is no more.
void RemoveLitter(const std::string& path) {
  const std::string name = fs::path(path).filename().string() + kTemporary;
  const fs::path folder = fs::absolute(path).parent_path();
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

}  // namespace

void WriteFileAtomically(const std::string& path, const std::string& content) {
  WriteFilesAtomically({{path, content}});
}

void WriteFilesAtomically(const std::vector<std::pair<std::string, std::string>>& files) {
  std::error_code ignored;
  for (const auto& [path, content] : files)
    if (fs::is_directory(path, ignored)) Fail(path, EISDIR, "name a file");
  std::vector<std::pair<std::string, std::string>> waiting;  // temporary and final names
  for (const auto& [path, content] : files) {
    const fs::file_status status = fs::status(path, ignored);
    const bool special = fs::exists(status) && !fs::is_regular_file(status);
    const std::string temporary = TemporaryName(path);
    int code = 0;
    if (special) {
      code = WriteAll(path, content, 0);
    } else {
      RemoveLitter(path);
      code = WriteAll(temporary, content, kNew);
      if (code != EEXIST) waiting.emplace_back(temporary, path);
    }
    if (code == 0) continue;
    for (const auto& [name, final_name] : waiting) unlink(name.c_str());
    if (special) Fail(path, code, "name another file");
    Fail(path, code,
         code == ENOSPC ? "make room or choose another folder" : "choose another folder");
  }
  for (const auto& [temporary, path] : waiting) {
    if (std::rename(temporary.c_str(), path.c_str()) == 0) continue;
    const int code = errno;
    for (const auto& [name, final_name] : waiting) unlink(name.c_str());  // only on failure
    Fail(path, code, "choose another folder");
  }
}

void MakeWritableFolder(const std::string& path) {
  std::error_code code, unseen;
  fs::create_directories(path, code);
  if (!fs::is_directory(path, unseen))
    Fail(path, code ? code.value() : unseen ? unseen.value() : ENOTDIR, "choose another folder");
  const std::string probe = TemporaryName(fs::path(path) / ".sslcd-probe");
  RemoveLitter(fs::path(path) / ".sslcd-probe");
  if (const int failed = WriteAll(probe, "", kNew)) Fail(path, failed, "choose another folder");
  unlink(probe.c_str());
}

}  // namespace sslcd
