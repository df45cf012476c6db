// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace sslcd::apps {

/// Throws Error(kUsage) if an input file is also an output file, under the same or another name.
/// `option` is the one that names the output. Ignores empty names and missing files.
void RefuseOverwriting(const std::vector<std::string>& read,
                       const std::vector<std::string>& written,
                       const std::string& option = "--out");

/// Throws Error(kUsage) if the folder to write is the folder that is read.
void RefuseFolder(const std::string& read, const std::string& written);

}  // namespace sslcd::apps
