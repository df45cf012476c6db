// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>

#include "sslcd/core/export.h"

namespace SSLCD_EXPORT sslcd {

/// The kind of an error. It determines the exit code of the command-line tools.
enum class ErrorKind {
  kUsage,       ///< the call itself is wrong (exit code 2)
  kBadInput,    ///< an input file or value is wrong (3)
  kBadConfig,   ///< a configuration key or value is wrong (4)
  kNoSolution,  ///< the input is valid, but there is no solution (5)
  kOutput,      ///< a result could not be written (1)
};

/// A place in a file. `line` and `column` count from 1; 0 means unknown.
struct FileLocation {
  std::string file;
  int line = 0;
  int column = 0;
};

/// "file:line:column" without unknown parts.
std::string ToString(const FileLocation& location);

/// The exception of this library. The message contains the problem, its place and a remedy.
class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& message);
  Error(ErrorKind kind, const FileLocation& where, const std::string& message);  // "where: message"

  ErrorKind kind() const { return kind_; }

 private:
  ErrorKind kind_;
};

}  // namespace sslcd
