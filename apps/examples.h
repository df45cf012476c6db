// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <initializer_list>
#include <string>

namespace sslcd::apps {

/// The examples at the end of a subcommand's help: lines without the program's name.
inline std::string Examples(std::initializer_list<const char*> lines) {
  std::string text = "Examples:";
  for (const char* line : lines) text += std::string("\n  sslcd_run ") + line;
  return text;
}

}  // namespace sslcd::apps
