// SPDX-License-Identifier: BSD-3-Clause
#include "eval/odometry_returns.h"

#include <vector>

#include "eval/path.h"

namespace sslcd {
namespace {

// A camera that is compared.
struct Stop {
  std::size_t row = 0;
  double at_m = 0;
  Vec3 position{0, 0, 0};  // its projection onto the horizontal plane
};

std::vector<Stop> StopsAlong(const Trajectory& path, const Vec3& up, double spacing_m) {
  const std::vector<double> distance = DistanceAlong(path.poses);
  std::vector<Stop> stops;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (!stops.empty() && distance[i] - stops.back().at_m < spacing_m) continue;
    const Vec3 position = path.poses[i].translation();
    stops.push_back({i, distance[i], position - up * up.dot(position)});
  }
  return stops;
}

}  // namespace

OdometryReturns FindReturns(const Trajectory& path, const Vec3& up, const ReturnOptions& options) {
  const std::vector<Stop> stops = StopsAlong(path, up, options.spacing_m);
  OdometryReturns returns;
  bool was_back = false;
  for (const Stop& stop : stops) {
    bool back = false;
    for (const Stop& old : stops) {
      if (stop.at_m - old.at_m < options.old_m) break;
      const double distance = (stop.position - old.position).norm();
      back = back || distance <= options.radius_m;
      if (!returns.nearest || distance < returns.nearest->distance_m)
        returns.nearest = Approach{stop.row, old.row, distance, stop.at_m - old.at_m};
    }
    returns.stretches += back && !was_back ? 1 : 0;
    was_back = back;
  }
  return returns;
}

}  // namespace sslcd
