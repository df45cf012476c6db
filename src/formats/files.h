// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace sslcd {

struct NumberedFile {
  int number = 0;
  std::string path;
};

/// The files of a folder whose name is a number and `extension` (".txt"), by number. Throws Error
/// when the folder cannot be read or when two names are the same number (7.txt, 000007.txt).
std::vector<NumberedFile> NumberedFiles(const std::string& folder, const std::string& extension);

/// Names in a folder, sorted; empty when there is no such folder.
std::vector<std::string> FileNames(const std::string& folder);

bool IsFile(const std::string& path);
bool IsFolder(const std::string& path);

/// The path, or nothing where there is no such file, or folder.
std::string IfFile(const std::string& path);
std::string IfFolder(const std::string& path);

/// The last name of a path, also of ".", "a/.." and "a/".
std::string LastName(const std::string& folder);

/// "a, b, c", or "nothing".
std::string Join(const std::vector<std::string>& names);

}  // namespace sslcd
