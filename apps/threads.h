// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace sslcd::apps {

/// What the machine has.
int HardwareThreads();

/// Adds --threads, from `least` on. What it says bounds OpenCV's own pool, too: that is the
/// program's to decide, not the library's.
void AddThreads(CLI::App& command, int& threads, int least = 1,
                const std::string& meaning = "upper limit; the answer does not depend on it");

}  // namespace sslcd::apps
