// SPDX-License-Identifier: BSD-3-Clause
#include "map/map_landmark.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sslcd {
namespace {

// Sizes of LiDAR and stereo scatter twice as much at this range as at 0. Set by hand. [m]
constexpr double kTwiceAt = 20.;
// A size that differs by this share from the median has half the weight (Cauchy). Set by hand.
constexpr double kHalfWeightOff = 0.15;

struct Weighted {
  double value, weight;
};

double WeightedMedian(std::vector<Weighted> samples) {
  std::sort(samples.begin(), samples.end(),
            [](const Weighted& a, const Weighted& b) { return a.value < b.value; });
  double total = 0;
  for (const Weighted& sample : samples) total += sample.weight;
  double seen = 0;
  for (const Weighted& sample : samples) {
    seen += sample.weight;
    if (seen >= 0.5 * total) return sample.value;
  }
  return samples.back().value;
}

}  // namespace

Vec3 FuseDims(const std::vector<Sighting>& sightings) {
  assert(!sightings.empty());
  Vec3 dims;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<Weighted> samples;
    for (const Sighting& sighting : sightings) {
      const double range = sighting.T_cam_object.translation().norm();
      const double sigma = 1 + range / kTwiceAt;
      samples.push_back({sighting.dims[axis], sighting.score / (sigma * sigma)});
    }
    const double centre = WeightedMedian(samples);
    double sum = 0, weights = 0;
    for (const Weighted& sample : samples) {
      const double off = (sample.value - centre) / (kHalfWeightOff * centre);
      const double weight = sample.weight / (1 + off * off);
      sum += weight * sample.value;
      weights += weight;
    }
    dims[axis] = sum / weights;
  }
  return dims;
}

double VoteHeading(double yaw, const std::vector<Vec2>& headings) {
  const Vec2 ahead(std::cos(yaw), std::sin(yaw));
  int agreement = 0;
  for (const Vec2& heading : headings) agreement += ahead.dot(heading) >= 0 ? 1 : -1;
  return WrapAngle(agreement >= 0 ? yaw : yaw + M_PI);
}

}  // namespace sslcd
