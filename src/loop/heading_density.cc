// SPDX-License-Identifier: BSD-3-Clause
#include "loop/heading_density.h"

#include <cmath>

namespace sslcd {

double HeadingDensity(double difference_rad, Symmetry symmetry) {
  // Set by hand without a recorded search.
  constexpr double kSharpness = 16.;  // of the von Mises density: a sigma of about 15 degrees
  constexpr double kFlipped = 0.05;   // share of headings with an error of half a turn
  constexpr double kAny = 0.1;        // share of random headings
  const double peak = std::sqrt(kSharpness / (2 * M_PI));
  const double forward = peak * std::exp(kSharpness * (std::cos(difference_rad) - 1));
  const double reverse = peak * std::exp(kSharpness * (-std::cos(difference_rad) - 1));
  const double flipped = symmetry == Symmetry::kPi ? 0.5 : kFlipped;
  return (1 - kAny) * ((1 - flipped) * forward + flipped * reverse) + kAny / (2 * M_PI);
}

const std::vector<double>& HeadingDensities(Symmetry symmetry) {
  const auto compute = [](Symmetry s) {
    std::vector<double> densities;
    for (int degree = 0; degree < 360; ++degree)
      densities.push_back(HeadingDensity(degree * M_PI / 180, s));
    return densities;
  };
  static const std::vector<double> kFullTurn = compute(Symmetry::kNone),
                                   kHalfTurn = compute(Symmetry::kPi);
  return symmetry == Symmetry::kPi ? kHalfTurn : kFullTurn;
}

}  // namespace sslcd
