// SPDX-License-Identifier: BSD-3-Clause
#include "odometry/pattern_search.h"

namespace sslcd {

std::array<double, 2> MaximiseOverLogs(
    const std::function<double(const std::array<double, 2>&)>& value) {
  constexpr double kFirstStep = 1, kLastStep = 0.02;
  std::array<double, 2> best{0, 0};
  double best_value = value(best);
  for (double step = kFirstStep; step > kLastStep;) {
    bool better = false;
    for (const int i : {0, 1})
      for (const double move : {-step, step}) {
        std::array<double, 2> tried = best;
        tried[i] += move;
        const double here = value(tried);
        if (!(here > best_value)) continue;
        best = tried;
        best_value = here;
        better = true;
      }
    if (!better) step /= 2;
  }
  return best;
}

}  // namespace sslcd
