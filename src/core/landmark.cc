// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/core/landmark.h"

namespace sslcd {

const char* ToString(LandmarkState state) {
  switch (state) {
    case LandmarkState::kTentative: return "tentative";
    case LandmarkState::kConfirmed: return "confirmed";
    case LandmarkState::kDynamic: return "dynamic";
    case LandmarkState::kStale: return "stale";
  }
  return "?";
}

}  // namespace sslcd
