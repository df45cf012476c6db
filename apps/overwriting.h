// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace sslcd::apps {

/// Throws Error(kUsage) if one of the files that are read is one of those that are to be written,
/// under whatever name. Empty names, and files that are not there, are none.
void RefuseOverwriting(const std::vector<std::string>& read,
                       const std::vector<std::string>& written);

}  // namespace sslcd::apps
