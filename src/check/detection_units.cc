// SPDX-License-Identifier: BSD-3-Clause
#include "check/detection_units.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "check/cuboid.h"
#include "core/median.h"

namespace sslcd::check {
namespace {

constexpr std::size_t kLeastSized = 20, kLeastCuboids = 50, kLeastNumbered = 10;
constexpr double kLargestSide = 100;     // [m]
constexpr double kLargestInCm = 1000;    // a car of 4.5 m is 450 cm or 4500 mm long
constexpr double kFarthestCuboid = 300;  // sides
constexpr double kFlat = 0.3, kHeight = 3, kWide = 5, kLow = 1;  // of coordinates [m]

Vec3 Placed(const Row& row) { return ReadCuboid(row.detection).bottom; }

double Coordinate(const Sequence& sequence, int axis, double quantile) {
  std::vector<double> values;
  for (const Row& row : sequence.rows) values.push_back(Placed(row)[axis]);
  const auto at = values.begin() +
                  static_cast<std::ptrdiff_t>(quantile * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

double Spread(const Sequence& sequence, int axis) {
  return Coordinate(sequence, axis, 0.9) - Coordinate(sequence, axis, 0.1);
}

std::function<void(Sequence&)> Renumber(int factor, int first) {
  return [factor, first](Sequence& s) {
    for (Row& row : s.rows) row.frame = row.frame / factor - first;
  };
}

/// A laser's x forward, y left, z up, with a yaw about z.
void TurnToCamera(bool heading_too, Row& row) {
  FileCuboid cuboid = ReadCuboid(row.detection);
  const Vec3 p = cuboid.bottom;
  cuboid.bottom = Vec3(-p.y(), -p.z(), p.x());
  if (heading_too) cuboid.rotation_y = WrapAngle(-cuboid.rotation_y - M_PI / 2);
  WriteCuboid(cuboid, row);
}

double AlphaError(const Sequence& sequence, bool heading_too) {
  std::vector<double> errors;
  for (Row row : sequence.rows) {
    TurnToCamera(heading_too, row);
    errors.push_back(
        std::abs(WrapAngle(row.written.alpha - row.written.rotation_y + Bearing(row.detection))));
  }
  return Median(std::move(errors));
}

}  // namespace

Outcome CheckFrameNumbers(const Sequence& sequence) {
  if (sequence.rows.empty()) return NotTestable("no detections");
  int least = std::numeric_limits<int>::max(), most = 0, divisor = 0;
  std::size_t beyond = 0;
  for (const Row& row : sequence.rows) {
    least = std::min(least, row.frame);
    most = std::max(most, row.frame);
    divisor = std::gcd(divisor, row.frame);
    beyond += row.frame >= sequence.frames() ? 1 : 0;
  }
  const std::string measured = "detections of frames " + std::to_string(least) + " to " +
                               std::to_string(most) + ", poses of frames 0 to " +
                               std::to_string(sequence.frames() - 1);
  if (beyond == 0 || sequence.rows.size() < kLeastNumbered) return Ok(measured);
  if (least >= 1 && most == sequence.frames())
    return Found("frame_numbers", measured + ": the detections count from 1", Renumber(1, 1));
  if (divisor > 1 && most / divisor < sequence.frames())
    return Found("frame_numbers",
                 measured + ": all of the detections' are multiples of " + std::to_string(divisor),
                 Renumber(divisor, 0));
  if (least >= sequence.frames())
    return Found("frame_numbers", measured + ": no detection has a pose");
  return Ok(measured);
}

Outcome CheckCuboidUnits(const Sequence& sequence) {
  if (sequence.rows.size() < kLeastSized)
    return NotTestable("fewer than " + std::to_string(kLeastSized) + " detections");
  std::vector<double> sides, ranges;
  for (const Row& row : sequence.rows) {
    sides.push_back(row.detection.dims.maxCoeff());
    ranges.push_back(Placed(row).norm());
  }
  const double side = Median(std::move(sides)), range = Median(std::move(ranges));
  const std::string measured =
      "cuboids of " + Metres(side) + " at " + Metres(range) + " from the camera (medians)";
  const double size_factor = side <= kLargestSide ? 1 : side <= kLargestInCm ? 0.01 : 0.001;
  const double farthest = kFarthestCuboid * std::max(1., side * size_factor);
  double factor = 1;  // of places
  if (range > farthest) factor = size_factor < 1 ? size_factor : 0.01;
  if (range * factor > farthest) factor = 0.001;
  if (size_factor == 1 && factor == 1) return Ok(measured);
  const auto unit = [](double f) { return f == 1 ? "m" : f == 0.01 ? "cm" : "mm"; };
  return Found("cuboid_units",
               measured + ": sizes in " + unit(size_factor) + ", places in " + unit(factor),
               [size_factor, factor](Sequence& s) {
                 for (Row& row : s.rows) {
                   FileCuboid cuboid = ReadCuboid(row.detection);
                   cuboid.bottom *= factor;
                   cuboid.h *= size_factor;
                   cuboid.w *= size_factor;
                   cuboid.l *= size_factor;
                   WriteCuboid(cuboid, row);
                 }
               });
}

Outcome CheckDetectionAxes(const Sequence& sequence) {
  if (sequence.rows.size() < kLeastCuboids)
    return NotTestable("fewer than " + std::to_string(kLeastCuboids) + " detections");
  const double z = Coordinate(sequence, 2, 0.5), deep = Spread(sequence, 2),
               wide = Spread(sequence, 0);
  const std::string measured =
      "x spreads over " + Metres(wide) + ", z over " + Metres(deep) + " about " + Metres(z);
  if (!(wide > kWide && deep < kFlat * wide && std::abs(z) < kHeight && z < kLow))
    return Ok(measured);
  const bool heading_too =
      !HasAlphas(sequence) || AlphaError(sequence, true) < AlphaError(sequence, false);
  return Found("velodyne_frame", measured + ": z is a height, and x points forward",
               [heading_too](Sequence& s) {
                 for (Row& row : s.rows) TurnToCamera(heading_too, row);
               });
}

}  // namespace sslcd::check
