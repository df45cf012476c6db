// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>
#include <functional>
#include <thread>
#include <vector>

#include "sslcd/pipeline/mapper.h"

namespace sslcd {

/// Refines a copy of a mapper on a thread of its own, and remembers what the mapper gets meanwhile.
/// The result does not depend on how long the refinement takes: it is that of a mapper that was
/// refined between two frames.
class BackgroundRefinement {
 public:
  /// Calls `done` on its thread when the copy is refined, or has failed.
  BackgroundRefinement(const Mapper& mapper, Refinement when, std::function<void()> done)
      : copy_(mapper), done_(std::move(done)), thread_([this, when] { Run(when); }) {}
  ~BackgroundRefinement() {
    if (thread_.joinable()) thread_.join();
  }
  BackgroundRefinement(const BackgroundRefinement&) = delete;
  BackgroundRefinement& operator=(const BackgroundRefinement&) = delete;

  /// The mapper has got a frame.
  void Add(AddedFrame frame) { since_.push_back(std::move(frame)); }

  /// Waits for the copy, lets it catch up with the mapper, and replaces the mapper by it. Throws
  /// what the refinement has thrown.
  void Replace(Mapper& mapper) {
    thread_.join();
    if (failure_) std::rethrow_exception(failure_);
    copy_.CatchUp(mapper, since_);
    mapper = std::move(copy_);
  }

 private:
  void Run(Refinement when) {
    try {
      copy_.Refine(when);
    } catch (...) {
      failure_ = std::current_exception();
    }
    done_();
  }

  Mapper copy_;
  std::vector<AddedFrame> since_;
  std::function<void()> done_;
  std::exception_ptr failure_;
  std::thread thread_;  // the last member: it starts when all others are there
};

}  // namespace sslcd
