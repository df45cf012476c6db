// SPDX-License-Identifier: BSD-3-Clause
#include "formats/files.h"

#include <dirent.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <memory>

#include "sslcd/core/error.h"

namespace sslcd {
namespace fs = std::filesystem;

std::vector<std::string> FileNames(const std::string& folder) {
  std::vector<std::string> names;
  // std::filesystem's iterators end the program where memory is short
  const std::unique_ptr<DIR, int (*)(DIR*)> opened(opendir(folder.c_str()), closedir);
  while (const dirent* entry = opened ? readdir(opened.get()) : nullptr) {
    const std::string name = entry->d_name;
    if (name != "." && name != "..") names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<NumberedFile> NumberedFiles(const std::string& folder, const std::string& extension) {
  if (!IsFolder(folder)) throw Error(ErrorKind::kBadInput, {folder}, "no such folder");
  std::vector<NumberedFile> files;
  for (const std::string& name : FileNames(folder)) {
    const fs::path path(name);
    const std::string stem = path.stem().string();
    int number = 0;
    const auto [end, error] = std::from_chars(stem.data(), stem.data() + stem.size(), number);
    const bool is_number = error == std::errc() && end == stem.data() + stem.size() && number >= 0;
    if (is_number && path.extension() == extension)
      files.push_back({number, (fs::path(folder) / name).string()});
  }
  const auto by_number = [](const NumberedFile& a, const NumberedFile& b) {
    return a.number < b.number;
  };
  std::sort(files.begin(), files.end(), by_number);
  for (std::size_t i = 1; i < files.size(); ++i) {
    if (files[i].number == files[i - 1].number) {
      throw Error(ErrorKind::kBadInput, {files[i].path},
                  "is the same number as " + files[i - 1].path + ": remove one");
    }
  }
  return files;
}

bool IsFile(const std::string& path) {
  std::error_code error;
  return fs::exists(path, error) && !fs::is_directory(path, error);
}

bool IsFolder(const std::string& path) {
  std::error_code error;
  return fs::is_directory(path, error);
}

std::string IfFile(const std::string& path) {
  std::error_code error;
  const fs::file_status named = fs::symlink_status(path, error);
  if (named.type() == fs::file_type::not_found) return "";
  const auto fail = [&path](const std::string& what) {
    throw Error(ErrorKind::kBadInput, {path},
                "is there, but " + what + ": put a file in its place, or remove it");
  };
  if (error) fail("cannot be read (" + error.message() + ")");
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) fail("is a link that leads nowhere");
  if (error) fail("cannot be read (" + error.message() + ")");
  if (fs::is_directory(status)) fail("is a folder");
  return path;
}
std::string IfFolder(const std::string& path) { return IsFolder(path) ? path : ""; }

std::string LastName(const std::string& folder) {
  const auto path = fs::absolute(folder).lexically_normal();
  return (path.has_filename() ? path : path.parent_path()).filename().string();
}

std::string Join(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return names.empty() ? "nothing" : text;
}

}  // namespace sslcd
