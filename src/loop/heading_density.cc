// SPDX-License-Identifier: BSD-3-Clause
#include "loop/heading_density.h"

#include <array>
#include <cmath>
#include <limits>
#include <tuple>

namespace sslcd {
namespace {

constexpr int kHeadings = 72;  // number of rotations to try, bins of five degrees
using Background = std::array<double, kHeadings>;

// log density of the map's headings plus one uniform heading [log 1/rad]
Background LogDensityOf(const LayoutCounts::Headings& map) {
  Background background{};
  int headings = 0;
  for (const Symmetry symmetry : {Symmetry::kNone, Symmetry::kPi}) {
    const auto& counts = map[symmetry == Symmetry::kPi];
    const std::vector<double>& densities = HeadingDensities(symmetry);
    const int bins = static_cast<int>(counts.size());
    static_assert(std::tuple_size_v<LayoutCounts::Headings::value_type> % kHeadings == 0);
    for (int from = 0; from < bins; ++from) {
      if (counts[from] == 0) continue;
      headings += counts[from];
      int difference = from == 0 ? 0 : bins - from;
      for (double& density : background) {
        density += counts[from] * densities[difference];
        difference += bins / kHeadings;
        if (difference >= bins) difference -= bins;
      }
    }
  }
  for (double& density : background)
    density = std::log((density + 1 / (2 * M_PI)) / (headings + 1));
  return background;
}

}  // namespace

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

std::vector<double> ChanceHeadings(const std::vector<LayoutObject>& local,
                                   const LayoutCounts::Headings& map) {
  const Background background = LogDensityOf(map);
  std::array<int, kHeadings> count{};  // of local objects by heading
  std::vector<int> bins;
  for (const LayoutObject& object : local) {
    if (!HasHeading(object)) {
      bins.push_back(-1);
      continue;
    }
    const double turns = WrapAngle(object.yaw) / (2 * M_PI) + 1;
    bins.push_back(static_cast<int>(std::floor(turns * kHeadings + 0.5)) % kHeadings);
    ++count[bins.back()];
  }
  int best = 0;
  double likeliest = -std::numeric_limits<double>::infinity();
  for (int turn = 0; turn < kHeadings; ++turn) {
    double sum = 0;
    for (int bin = 0; bin < kHeadings; ++bin)
      if (count[bin] > 0) sum += count[bin] * background[(bin + turn) % kHeadings];
    if (sum <= likeliest) continue;
    likeliest = sum;
    best = turn;
  }
  std::vector<double> chance;
  for (const int bin : bins) chance.push_back(bin < 0 ? 0. : background[(bin + best) % kHeadings]);
  return chance;
}

}  // namespace sslcd
