// SPDX-License-Identifier: BSD-3-Clause
#include "sim/random.h"

#include <cmath>

namespace sslcd::sim {

double Random::Normal() {
  // Box-Muller. Drops the second value, so that the engine is the only state.
  const double radius = std::sqrt(-2. * std::log(1. - Uniform()));
  return radius * std::cos(2. * M_PI * Uniform());
}

int Random::Poisson(double mean) {
  int count = 0;
  for (double sum = -std::log(1. - Uniform()); sum < mean; sum -= std::log(1. - Uniform())) ++count;
  return count;
}

}  // namespace sslcd::sim
