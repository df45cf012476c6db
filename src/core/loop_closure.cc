// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/core/loop_closure.h"

#include <algorithm>

namespace sslcd {

const char* ToString(LoopDecision decision) {
  switch (decision) {
    case LoopDecision::kNone: return "none";
    case LoopDecision::kAmbiguous: return "ambiguous";
    case LoopDecision::kAccepted: return "accepted";
  }
  return "none";
}

std::vector<LoopClosure> WithoutEarly(std::vector<LoopClosure> loops) {
  loops.erase(std::remove_if(loops.begin(), loops.end(),
                             [](const LoopClosure& loop) { return loop.early; }),
              loops.end());
  return loops;
}

}  // namespace sslcd
