// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace sslcd {

/// The words with which this program was called, its name first. Empty where the system does not
/// tell (no /proc).
std::vector<std::string> CommandWords();

/// The words as a line for a shell: words with blanks are in quotes.
std::string CommandLine(const std::vector<std::string>& words);

}  // namespace sslcd
