// SPDX-License-Identifier: BSD-3-Clause
#include "overwriting.h"

#include <filesystem>

#include "sslcd/core/error.h"

namespace sslcd::apps {

void RefuseOverwriting(const std::vector<std::string>& read,
                       const std::vector<std::string>& written) {
  std::error_code none;
  for (const std::string& input : read)
    for (const std::string& output : written)
      if (std::filesystem::equivalent(input, output, none))
        throw Error(ErrorKind::kUsage,
                    input + ": is read, and would be overwritten; name another folder with --out");
}

}  // namespace sslcd::apps
