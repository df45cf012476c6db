// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "console.h"
#include "sslcd/core/loop_closure.h"

namespace sslcd::apps {

/// "frame 812 to 33, viewpoint change 178 deg, 9 objects, probability 0.9998".
std::string LoopText(const LoopClosure& loop, const std::function<std::string(int)>& frame_name);

/// Prints a line for each loop that is accepted or withdrawn, when it happens. Nothing when the
/// console is quiet; refused attempts too when it is verbose.
class LoopLines {
 public:
  explicit LoopLines(const Console& console) : console_(console) {}

  /// For a drive that is added to a map: the attempts before it, which are not news, and how its
  /// frames are called. Otherwise they are called by their numbers.
  void Begin(const std::vector<LoopClosure>& known, std::function<std::string(int frame)> name);

  /// Takes attempts that are new or have changed. Of many at once, as a refinement brings them, it
  /// prints the number.
  void Report(const std::vector<LoopClosure>& changed);

 private:
  void Print(const std::string& event, const std::vector<const LoopClosure*>& loops,
             bool with_reason) const;

  const Console& console_;
  std::function<std::string(int)> frame_name_ = [](int frame) { return std::to_string(frame); };
  std::map<int, LoopDecision> known_;  // by LoopClosure::id
};

}  // namespace sslcd::apps
