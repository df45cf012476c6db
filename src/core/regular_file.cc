// SPDX-License-Identifier: BSD-3-Clause
#include "core/regular_file.h"

#include <filesystem>

#include "sslcd/core/error.h"

namespace sslcd {

void RequireRegularFile(const std::string& path) {
  const auto refuse = [&path](const std::string& what) {
    throw Error(ErrorKind::kBadInput, {path}, what);
  };
  const std::string way_out = ", expected a file: write its content into one";
  std::error_code ignored;
  switch (std::filesystem::status(path, ignored).type()) {
    case std::filesystem::file_type::directory: return refuse("is a folder, expected a file");
    case std::filesystem::file_type::fifo: return refuse("is a pipe" + way_out);
    case std::filesystem::file_type::socket: return refuse("is a socket" + way_out);
    case std::filesystem::file_type::block:
    case std::filesystem::file_type::character: return refuse("is a device" + way_out);
    default: return;
  }
}

}  // namespace sslcd
