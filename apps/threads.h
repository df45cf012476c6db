// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace sslcd::apps {

/// The number of hardware threads, at least 1.
int HardwareThreads();

/// Adds --threads with the smallest value `least`. It also limits OpenCV's thread pool, which only
/// the program may set, not the library.
void AddThreads(CLI::App& command, int& threads, int least = 1,
                const std::string& meaning = "upper limit; the answer does not depend on it");

}  // namespace sslcd::apps
