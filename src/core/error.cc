// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/core/error.h"

namespace sslcd {

std::string ToString(const FileLocation& location) {
  std::string text = location.file;
  if (location.line > 0) text += ":" + std::to_string(location.line);
  if (location.line > 0 && location.column > 0) text += ":" + std::to_string(location.column);
  return text;
}

Error::Error(ErrorKind kind, const std::string& message)
    : std::runtime_error(message), kind_(kind) {}

Error::Error(ErrorKind kind, const FileLocation& where, const std::string& message)
    : std::runtime_error(ToString(where) + ": " + message), kind_(kind) {}

}  // namespace sslcd
