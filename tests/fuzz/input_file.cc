// SPDX-License-Identifier: BSD-3-Clause
#include "input_file.h"

#include <sys/mman.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace sslcd::fuzz {
namespace {

namespace fs = std::filesystem;

constexpr int kMostFiles = 40;

// Removed when the process ends, unless it crashes.
class Folder {
 public:
  Folder() : path_((fs::temp_directory_path() / "sslcd_fuzz_XXXXXX").string()) {
    if (::mkdtemp(path_.data()) == nullptr) throw std::runtime_error("no temporary folder");
  }
  ~Folder() { fs::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

bool IsName(const std::string& name) {
  const bool plain = name.find_first_not_of(
                         "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._-/") ==
                     std::string::npos;
  return plain && !name.empty() && name.size() < 60 && name.front() != '/' && name.back() != '/' &&
         name.find("..") == std::string::npos;
}

}  // namespace

std::string FileWith(const std::string& bytes) {
  static const int file = ::memfd_create("sslcd_fuzz", MFD_CLOEXEC);
  const auto size = static_cast<ssize_t>(bytes.size());
  if (::ftruncate(file, 0) != 0 || ::pwrite(file, bytes.data(), bytes.size(), 0) != size)
    throw std::runtime_error("no file in memory");
  return "/proc/self/fd/" + std::to_string(file);
}

std::string EmptyFolder() {
  static const Folder folder;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder.path()))
    fs::remove_all(entry);
  return folder.path();
}

std::string FolderWith(const std::string& text) {
  const std::string folder = EmptyFolder(), mark = "@@ ";
  std::size_t at = text.compare(0, mark.size(), mark) == 0 ? 0 : std::string::npos;
  for (int files = 0; files < kMostFiles && at != std::string::npos; ++files) {
    const std::size_t line = std::min(text.find('\n', at), text.size());
    const std::string name = text.substr(at + mark.size(), line - at - mark.size());
    at = text.find("\n" + mark, line);
    if (IsName(name)) {
      const fs::path path = fs::path(folder) / name;
      std::error_code ignored;  // a file may stand where a folder should
      fs::create_directories(path.parent_path(), ignored);
      const std::size_t begin = std::min(line + 1, text.size());
      std::ofstream stream(path, std::ios::binary);
      stream << text.substr(begin, at - begin);
      if (stream.is_open() && !stream.flush()) throw std::runtime_error("no room for " + name);
    }
    if (at != std::string::npos) ++at;
  }
  return folder;
}

}  // namespace sslcd::fuzz
