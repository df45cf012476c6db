// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

namespace sslcd {

/// The logs of factors that maximise a function of them, by a pattern search that starts at zero,
/// with steps from a factor of e to a few per cent.
template <std::size_t kCount, class Function>
std::array<double, kCount> MaximiseOverLogs(const Function& value) {
  constexpr double kFirstStep = 1, kLastStep = 0.02;
  std::array<double, kCount> best{};
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
