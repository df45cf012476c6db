// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <string>

#include "console.h"

namespace sslcd::apps {

/// The progress of countable work as one line that is rewritten: "frame 120/400, 35 frames/s, 8 s
/// left". Only on a terminal.
class Progress {
 public:
  /// `what` is counted.
  Progress(const Console& console, std::string what);

  /// To be called whenever more is done; most calls show nothing, so that they cost little. The
  /// rate is that since the first call. Where less is done than before, another count begins.
  void Report(int done, int total);

 private:
  std::string Line(int done, int total, double seconds) const;

  using Clock = std::chrono::steady_clock;
  const Console& console_;
  std::string what_;
  Clock::time_point start_{}, shown_{};
  int first_ = 0, last_ = 0;  // done at the start, and at the last call
};

}  // namespace sslcd::apps
