// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace sslcd {

/// The logs of factors that maximise a function of them, by a pattern search with steps from a
/// factor of 1.3 to a few per cent. It begins at `start`, rounded to the first step: the result is
/// a multiple of the last one and hardly depends on the start, but a near start is quicker.
template <std::size_t kCount, class Function>
std::array<double, kCount> MaximiseOverLogs(const Function& value,
                                            const std::array<double, kCount>& start = {}) {
  constexpr double kFirstStep = 0.25, kLastStep = 0.02;
  std::array<double, kCount> best{};
  for (std::size_t i = 0; i < kCount; ++i) best[i] = kFirstStep * std::round(start[i] / kFirstStep);
  double best_value = value(best);
  for (double step = kFirstStep; step > kLastStep;) {
    bool better = false;
    for (std::size_t i = 0; i < kCount; ++i)
      for (const double move : {-step, step}) {
        std::array<double, kCount> tried = best;
        tried[i] += move;
        const double here = value(tried);
        if (!(here > best_value)) continue;
        best = tried;
        best_value = here;
        better = true;
        break;  // the other way is where this came from
      }
    if (!better) step /= 2;
  }
  return best;
}

}  // namespace sslcd
