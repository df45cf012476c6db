// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "core/source.h"

namespace sslcd {

/// Runs a source on a thread of its own, up to `ahead` items before the consumer. Items keep the
/// order of the source. An exception of the source is thrown in place of its item.
template <class T>
class Background {
 public:
  Background(Source<T> source, std::size_t ahead)
      : source_(std::move(source)), ahead_(ahead), thread_([this] { Work(); }) {}
  Background(const Background&) = delete;
  Background& operator=(const Background&) = delete;

  /// Waits only for the current item of the source.
  ~Background() {
    {
      const std::lock_guard lock(mutex_);
      stopped_ = true;
    }
    room_.notify_all();
    thread_.join();
  }

  std::optional<T> Next() {
    std::unique_lock lock(mutex_);
    more_.wait(lock, [this] { return !items_.empty() || ended_; });
    if (!items_.empty()) {
      T item = std::move(items_.front());
      items_.pop_front();
      room_.notify_all();
      return item;
    }
    if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
    return std::nullopt;
  }

 private:
  void Work() {
    std::exception_ptr error;
    try {
      while (std::optional<T> item = source_()) {
        std::unique_lock lock(mutex_);
        room_.wait(lock, [this] { return items_.size() < ahead_ || stopped_; });
        if (stopped_) return;
        items_.push_back(std::move(*item));
        more_.notify_all();
      }
    } catch (...) {
      error = std::current_exception();
    }
    const std::lock_guard lock(mutex_);
    error_ = error;
    ended_ = true;
    more_.notify_all();
  }

  Source<T> source_;
  std::size_t ahead_;
  std::mutex mutex_;
  std::condition_variable more_, room_;
  std::deque<T> items_;
  std::exception_ptr error_;
  bool ended_ = false, stopped_ = false;
  std::thread thread_;  // the last member: it uses the others
};

}  // namespace sslcd
