// SPDX-License-Identifier: BSD-3-Clause
#include "threads.h"

#include <algorithm>
#include <opencv2/core/utility.hpp>
#include <thread>

namespace sslcd::apps {

int HardwareThreads() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

void AddThreads(CLI::App& command, int& threads, int least, const std::string& meaning) {
  const auto set = [&threads](int given) {
    threads = given;
    cv::setNumThreads(given > 0 ? std::min(given, HardwareThreads()) : HardwareThreads());
  };
  command.add_option_function<int>("--threads", set, meaning)->check(CLI::Range(least, 1024));
}

}  // namespace sslcd::apps
