// SPDX-License-Identifier: BSD-3-Clause
#include "sim/slots.h"

#include <algorithm>
#include <cmath>

#include "eval/iou3d.h"

namespace sslcd::sim {
namespace {

// A car park and a street, all in metres. Set by hand.
constexpr double kLength = 4.8, kWidth = 1.9;         // size of a slot's vehicle
constexpr double kClearance = 1.2;                    // from the camera's path to a vehicle
constexpr double kStall = 2.6;                        // width of a stall
constexpr double kAisles = 16.6;                      // from one aisle's middle to the next one's
constexpr double kToStall = 5.5;                      // from an aisle's middle to that of a stall
constexpr double kAround = 14;                        // margin of the car park around the path
constexpr double kSpace = 5.8;                        // a kerb-side parking space
constexpr double kRightKerb = 3.2, kLeftKerb = -6.6;  // to the right of the path

struct Range {
  int first, last;
};

/// Multiples of `step` that cover the coordinates of all points and a margin.
Range Multiples(const std::vector<Path::Point>& points, double Path::Point::*coordinate,
                double step) {
  const auto [low, high] = std::minmax_element(
      points.begin(), points.end(),
      [&](const auto& a, const auto& b) { return a.*coordinate < b.*coordinate; });
  return {static_cast<int>(std::floor(((*low).*coordinate - kAround) / step)),
          static_cast<int>(std::ceil(((*high).*coordinate + kAround) / step))};
}

Slot Beside(const Path& path, double s_m, double right_m, double turn_rad, const char* label = "") {
  const Path::Point at = path.At(s_m);
  return {at.x + right_m * std::cos(at.heading), at.z - right_m * std::sin(at.heading),
          at.heading + turn_rad, label};
}

bool IsClearOf(const Slot& slot, const std::vector<Slot>& others) {
  return std::none_of(others.begin(), others.end(),
                      [&](const Slot& other) { return Overlap(slot, other); });
}

}  // namespace

Pose PoseOf(const Slot& slot, double y_m) {
  // Yaw counts from +x towards +z, the heading from +z towards +x.
  return Pose(GravityFrame().Upright(0.5 * M_PI - slot.heading), Vec3(slot.x, y_m, slot.z));
}

bool IsClear(const Slot& slot, const std::vector<Path::Point>& points) {
  const double sine = std::sin(slot.heading), cosine = std::cos(slot.heading);
  return std::none_of(points.begin(), points.end(), [&](const Path::Point& point) {
    const double x = point.x - slot.x, z = point.z - slot.z;
    return std::abs(x * sine + z * cosine) < 0.5 * kLength + kClearance &&
           std::abs(x * cosine - z * sine) < 0.5 * kWidth + kClearance;
  });
}

bool Overlap(const Slot& a, const Slot& b) {
  if (std::hypot(a.x - b.x, a.z - b.z) > std::hypot(kLength, kWidth)) return false;
  const Vec3 dims(kLength, kWidth, 1);
  const auto cuboid = [&](const Slot& slot) {
    return ToCuboid(PoseOf(slot, 0), dims, GravityFrame());
  };
  return FootprintIntersection(cuboid(a), cuboid(b)) > 0;
}

std::vector<Slot> LotSlots(const std::vector<Path::Point>& points) {
  const Range aisles = Multiples(points, &Path::Point::x, kAisles),
              stalls = Multiples(points, &Path::Point::z, kStall);
  std::vector<Slot> slots;
  for (int aisle = aisles.first; aisle <= aisles.last; ++aisle) {
    for (double side : {-1, 1}) {
      for (int stall = stalls.first; stall < stalls.last; ++stall) {
        const Slot slot{aisle * kAisles + side * kToStall, (stall + 0.5) * kStall,
                        side * 0.5 * M_PI, ""};
        if (IsClear(slot, points)) slots.push_back(slot);
      }
    }
  }
  return slots;
}

std::vector<Slot> StreetSlots(const Path& path, const std::vector<Path::Point>& points) {
  std::vector<Slot> slots;
  for (double s = 0.5 * kSpace - kAround; s < path.length() + kAround; s += kSpace) {
    for (const Slot& slot :
         {Beside(path, s, kRightKerb, 0), Beside(path, s + 2, kLeftKerb, M_PI)}) {
      if (IsClear(slot, points) && IsClearOf(slot, slots)) slots.push_back(slot);
    }
  }
  return slots;
}

std::vector<Slot> LotMarks(const std::vector<Path::Point>& points) {
  // Between the noses of two rows: a pole every eighth stall, a tree half-way to the next one.
  constexpr int kEvery = 8;
  const Range rows = Multiples(points, &Path::Point::x, kAisles);
  const Range marks = Multiples(points, &Path::Point::z, 0.5 * kEvery * kStall);
  std::vector<Slot> slots;
  for (int row = rows.first; row < rows.last; ++row) {
    for (int mark = marks.first; mark <= marks.last; ++mark) {
      const Slot slot{(row + 0.5) * kAisles, 0.5 * mark * kEvery * kStall, 0,
                      mark % 2 == 0 ? "Pole" : "Tree"};
      if (IsClear(slot, points)) slots.push_back(slot);
    }
  }
  return slots;
}

std::vector<Slot> StreetMarks(const Path& path, const std::vector<Path::Point>& points) {
  constexpr double kEvery = 24;
  std::vector<Slot> slots;
  for (double s = 8 - kAround; s < path.length() + kAround; s += kEvery) {
    for (const Slot& slot : {Beside(path, s, kRightKerb + 2, 0, "Pole"),
                             Beside(path, s + 0.5 * kEvery, kLeftKerb - 2, 0, "Tree")}) {
      if (IsClear(slot, points)) slots.push_back(slot);
    }
  }
  return slots;
}

}  // namespace sslcd::sim
