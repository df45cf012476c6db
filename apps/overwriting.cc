// SPDX-License-Identifier: BSD-3-Clause
#include "overwriting.h"

#include <filesystem>

#include "sslcd/core/error.h"

namespace sslcd::apps {

void RefuseOverwriting(const std::vector<std::string>& read,
                       const std::vector<std::string>& written, const std::string& option) {
  std::error_code none;
  for (const std::string& input : read)
    for (const std::string& output : written)
      if (std::filesystem::equivalent(input, output, none))
        throw Error(
            ErrorKind::kUsage,
            input + ": is read, and would be overwritten; name another place with " + option);
}

void RefuseFolder(const std::string& read, const std::string& written) {
  std::error_code none;
  if (std::filesystem::equivalent(read, written, none))
    throw Error(ErrorKind::kUsage,
                written +
                    ": is the data set, whose files would be replaced; name another folder "
                    "with --out");
}

}  // namespace sslcd::apps
