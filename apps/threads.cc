// SPDX-License-Identifier: BSD-3-Clause
#include "threads.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <opencv2/core/utility.hpp>
#include <system_error>
#include <thread>
#include <vector>

namespace sslcd::apps {

int HardwareThreads() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

void AddThreads(CLI::App& command, int& threads, int least, const std::string& meaning) {
  const auto set = [&threads](int given) {
    threads = given;
    cv::setNumThreads(given > 0 ? std::min(given, HardwareThreads()) : HardwareThreads());
  };
  command.add_option_function<int>("--threads", set, meaning)->check(CLI::Range(least, 1024));
}

void ForEach(std::size_t count, int threads, const std::function<void(std::size_t)>& work,
             const std::function<void(int done, int total)>& progress) {
  std::atomic<std::size_t> next{0};
  std::atomic<int> done{0};
  std::exception_ptr problem;
  std::mutex mutex;
  const auto take = [&](bool tells) {
    try {
      for (std::size_t i = next++; i < count; i = next++) {
        work(i);
        ++done;
        if (tells && progress) progress(done, static_cast<int>(count));
      }
    } catch (...) {
      const std::lock_guard<std::mutex> lock(mutex);
      if (!problem) problem = std::current_exception();
      next = count;
    }
  };
  std::vector<std::thread> helpers;
  try {
    for (std::size_t i = 1; i < std::min<std::size_t>(threads, count); ++i) helpers.emplace_back(take, false);
  } catch (const std::system_error&) {  // no more to be had
  }
  take(true);
  for (std::thread& helper : helpers) helper.join();
  if (problem) std::rethrow_exception(problem);
}

}  // namespace sslcd::apps
