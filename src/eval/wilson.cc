// SPDX-License-Identifier: BSD-3-Clause
#include "eval/wilson.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "sslcd/core/error.h"

namespace sslcd {

Interval WilsonInterval(int successes, int trials, double z) {
  if (successes < 0 || successes > trials || !(z >= 0)) {
    throw Error(ErrorKind::kUsage, "no interval for " + std::to_string(successes) +
                                       " successes in " + std::to_string(trials) +
                                       " trials at z = " + std::to_string(z));
  }
  if (trials == 0) return {};
  const double n = trials, p = successes / n, z2 = z * z;
  const double middle = (p + z2 / (2 * n)) / (1 + z2 / n);
  const double half = z / (1 + z2 / n) * std::sqrt(p * (1 - p) / n + z2 / (4 * n * n));
  // The ends are exactly 0 and 1 for no and only successes, despite rounding.
  return {successes == 0 ? 0. : std::max(0., middle - half),
          successes == trials ? 1. : std::min(1., middle + half)};
}

}  // namespace sslcd
