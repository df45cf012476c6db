// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <functional>
#include <string>

namespace sslcd::apps {

/// What the machine has.
int HardwareThreads();

/// Adds --threads, from `least` on. What it says bounds OpenCV's own pool, too: that is the program's to decide, not
/// the library's.
void AddThreads(CLI::App& command, int& threads, int least = 1,
                const std::string& meaning = "upper limit; the answer does not depend on it");

/// Calls work(i) for each i below `count`, on so many threads, in any order; the calling thread is one of them, and
/// says how far they are. The first exception ends it and is thrown.
void ForEach(std::size_t count, int threads, const std::function<void(std::size_t)>& work,
             const std::function<void(int done, int total)>& progress = {});

}  // namespace sslcd::apps
