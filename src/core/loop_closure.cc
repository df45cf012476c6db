// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/core/loop_closure.h"

namespace sslcd {

const char* ToString(LoopDecision decision) {
  switch (decision) {
    case LoopDecision::kNone: return "none";
    case LoopDecision::kAmbiguous: return "ambiguous";
    case LoopDecision::kAccepted: return "accepted";
  }
  return "none";
}

}  // namespace sslcd
