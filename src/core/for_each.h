// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace sslcd {

/// Calls work(i) for each i below `count`, in any order, on up to `threads` threads including the
/// calling one. Calls progress(done, count) after each, never twice at the same time, with `done`
/// counting from 1. The first exception of either stops all threads and is then thrown again. Needs
/// Threads::Threads.
inline void ForEach(std::size_t count, int threads, const std::function<void(std::size_t)>& work,
                    const std::function<void(int done, int count)>& progress = {}) {
  std::atomic<std::size_t> next{0};
  std::mutex mutex;  // protects `problem` and `done`
  std::exception_ptr problem;
  int done = 0;
  const auto take = [&] {
    try {
      for (std::size_t i = next++; i < count; i = next++) {
        work(i);
        const std::lock_guard<std::mutex> lock(mutex);
        ++done;
        if (progress) progress(done, static_cast<int>(count));
      }
    } catch (...) {
      const std::lock_guard<std::mutex> lock(mutex);
      if (!problem) problem = std::current_exception();
      next = count;
    }
  };
  std::vector<std::thread> helpers;
  const std::size_t most = std::min<std::size_t>(std::max(threads, 1), count);
  helpers.reserve(most);
  try {
    for (std::size_t i = 1; i < most; ++i) helpers.emplace_back(take);
  } catch (const std::system_error&) {  // no more to be had
  }
  take();
  for (std::thread& helper : helpers) helper.join();
  if (problem) std::rethrow_exception(problem);
}

}  // namespace sslcd
