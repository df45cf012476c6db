// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>

namespace sslcd {

/// What kind of trouble: decides the exit code of the command-line tools.
enum class ErrorKind {
  kUsage,       ///< the call itself is wrong (exit code 2)
  kBadInput,    ///< a file or value handed in is wrong (3)
  kBadConfig,   ///< a configuration key or value is wrong (4)
  kNoSolution,  ///< everything was read, but there is no answer (5)
  kOutput,      ///< a result could not be written (1)
};

/// Where in a file. `line` and `column` count from 1; 0 means unknown.
struct FileLocation {
  std::string file;
  int line = 0;
  int column = 0;
};

/// "file:line:column", leaving out what is unknown.
std::string ToString(const FileLocation& location);

/// The only exception this library throws on purpose. The message says what is wrong, where, and a
/// way out.
class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& message);
  Error(ErrorKind kind, const FileLocation& where, const std::string& message);  // "where: message"

  ErrorKind kind() const { return kind_; }

 private:
  ErrorKind kind_;
};

}  // namespace sslcd
