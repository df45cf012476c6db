// SPDX-License-Identifier: BSD-3-Clause
#include "lifting/object_scan.h"

#include <algorithm>
#include <cmath>

#include "core/median.h"

namespace sslcd {
namespace {

struct Column {
  std::vector<float> disparities;
  double u_sum = 0, v_sum = 0;
};

/// The point of the scan nearest to the column, if there is one nearby.
const ScanPoint* At(const std::vector<ScanPoint>& scan, double u, double reach_px) {
  const auto after = std::lower_bound(scan.begin(), scan.end(), u,
                                      [](const ScanPoint& p, double at) { return p.u < at; });
  const ScanPoint* best = nullptr;
  for (auto point = after == scan.begin() ? after : after - 1;
       point != scan.end() && point <= after; ++point) {
    if (std::abs(point->u - u) < (best ? std::abs(best->u - u) : reach_px)) best = &*point;
  }
  return best;
}

bool IsHidden(const std::vector<Nearer>& nearer, double u, double v, const Vec3& point,
              double depth, double bf) {
  // Margin behind the contour of a nearer object within which pixels belong to it, because
  // disparities scatter: share of the range, and metres. Set by hand.
  constexpr double kFartherShare = 1.03, kMargin = 0.2;
  // Largest distance of a column from a contour that covers it: share of the box's width, and
  // pixels. Set by hand.
  constexpr double kReachShare = 0.1, kReachPx = 4;
  return std::any_of(nearer.begin(), nearer.end(), [&](const Nearer& other) {
    const Box2d& box = other.box;
    if (u < box.left || u > box.right || v < box.top || v > box.bottom) return false;
    const ScanPoint* there =
        At(other.scan, u, std::max(kReachShare * (box.right - box.left), kReachPx));
    if (there && depth < bf / there->disparity * kFartherShare + kMargin) return true;
    return other.footprint ? other.footprint->Contains(point.x(), point.z(), kMargin) : !there;
  });
}

std::vector<Column> Columns(const DisparityPatch& patch, const Box2d& box,
                            const std::vector<Nearer>& nearer, const StereoCamera& camera,
                            const GroundFrame& ground, const ScanRules& rules) {
  const Camera& left = camera.left;
  const double bf = camera.baseline_m * left.fx;
  constexpr double kNarrowest = 2;  // [px] width of a column; set by hand
  const double width = std::max((box.right - box.left) / rules.columns, kNarrowest);
  std::vector<Column> columns(static_cast<std::size_t>((box.right - box.left) / width) + 1);
  for (int y = 0; y < patch.values.rows; ++y) {
    const float* row = patch.values.ptr<float>(y);
    const double v = patch.y0 + patch.step_y * y;
    if (v < box.top || v > box.bottom) continue;
    for (int x = 0; x < patch.values.cols; ++x) {
      const double u = patch.x0 + patch.step_x * x;
      if (!(row[x] > 0) || u < box.left || u > box.right) continue;
      const double z = bf / row[x];
      const Vec3 point =
          ground.FromCamera({z * (u - left.cx) / left.fx, z * (v - left.cy) / left.fy, z});
      if (point.y() < rules.low_m || point.y() > rules.high_m ||
          IsHidden(nearer, u, v, point, z, bf))
        continue;
      Column& column = columns[static_cast<std::size_t>((u - box.left) / width)];
      column.disparities.push_back(row[x]);
      column.u_sum += u;
      column.v_sum += v;
    }
  }
  return columns;
}

struct Weighed {
  ScanPoint point;
  double depth, pixels;
};

std::vector<Weighed> Medians(std::vector<Column> columns, double bf) {
  constexpr std::size_t kFewest = 4;  // smallest number of pixels in a column; set by hand
  std::vector<Weighed> medians;
  for (Column& column : columns) {
    if (column.disparities.size() < kFewest) continue;
    const double pixels = static_cast<double>(column.disparities.size());
    const double disparity = Median(column.disparities);
    medians.push_back(
        {{column.u_sum / pixels, column.v_sum / pixels, disparity}, bf / disparity, pixels});
  }
  return medians;
}

/// Moves the depth interval with most pixels out of `all`.
std::vector<ScanPoint> TakeStretch(std::vector<Weighed>& all, double length) {
  double most = 0, nearest = 0;
  for (const Weighed& start : all) {
    double pixels = 0;
    for (const Weighed& other : all) {
      if (other.depth >= start.depth && other.depth <= start.depth + length) pixels += other.pixels;
    }
    if (pixels <= most) continue;
    most = pixels;
    nearest = start.depth;
  }
  std::vector<ScanPoint> points;
  std::vector<Weighed> others;
  for (const Weighed& candidate : all) {
    if (candidate.depth >= nearest && candidate.depth <= nearest + length) {
      points.push_back(candidate.point);
    } else {
      others.push_back(candidate);
    }
  }
  all = std::move(others);
  return points;
}

}  // namespace

std::vector<std::vector<ScanPoint>> ScanObject(const DisparityPatch& patch, const Box2d& box,
                                               const std::vector<Nearer>& nearer,
                                               const StereoCamera& camera,
                                               const GroundFrame& ground, const ScanRules& rules) {
  const double bf = camera.baseline_m * camera.left.fx;
  std::vector<Weighed> all = Medians(Columns(patch, box, nearer, camera, ground, rules), bf);
  std::vector<std::vector<ScanPoint>> answers;
  constexpr int kAnswers = 2;  // the object, and another one before or behind it
  for (int i = 0; i < kAnswers; ++i) {
    std::vector<ScanPoint> points = TakeStretch(all, rules.depth_m);
    if (points.size() >= rules.fewest) answers.push_back(std::move(points));
  }
  return answers;
}

}  // namespace sslcd
