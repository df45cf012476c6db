// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace sslcd {

struct NumberedFile {
  int number = 0;
  std::string path;
};

/// The files of a folder whose name is a number and `extension` (".txt"), sorted by number. Throws
/// Error if the folder cannot be read or if two names have the same number (7.txt, 000007.txt).
std::vector<NumberedFile> NumberedFiles(const std::string& folder, const std::string& extension);

/// Sorted names in a folder; empty if there is no such folder.
std::vector<std::string> FileNames(const std::string& folder);

bool IsFile(const std::string& path);
bool IsFolder(const std::string& path);

/// Returns the path, or an empty string if there is nothing of this name. Throws Error(kBadInput)
/// if there is something else: a link that leads nowhere is no reason to do without the file.
std::string IfFile(const std::string& path);
/// Returns the path if it is a folder, otherwise an empty string.
std::string IfFolder(const std::string& path);

/// The last name of a path, including paths such as ".", "a/.." and "a/".
std::string LastName(const std::string& folder);

/// Joins the names: "a, b, c", or "nothing" if there are none.
std::string Join(const std::vector<std::string>& names);

}  // namespace sslcd
