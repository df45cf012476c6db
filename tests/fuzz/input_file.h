// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace sslcd::fuzz {

/// Path of a file in memory with these bytes; until the next call.
std::string FileWith(const std::string& bytes);

/// An empty folder of this process, until the next call.
std::string EmptyFolder();

/// Fills an empty folder with the files of a text, and returns it:
///
///   @@ times.txt
///   0.0
///   @@ image_2/000000.png
///   ...
///
/// Names have letters, digits, '.', '_', '-', and '/' between these. Other names, and files beyond
/// the first forty, are left out.
std::string FolderWith(const std::string& text);

}  // namespace sslcd::fuzz
