// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/object_scan.h"

#include <algorithm>
#include <cmath>

namespace sslcd {
namespace {

struct Column {
  std::vector<float> disparities;
  double u_sum = 0, v_sum = 0;
};

float Median(std::vector<float>& values) {
  const auto middle = values.begin() + values.size() / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

bool Covers(const std::vector<Box2d>& boxes, double u, double v) {
  return std::any_of(boxes.begin(), boxes.end(), [&](const Box2d& box) {
    return u >= box.left && u <= box.right && v >= box.top && v <= box.bottom;
  });
}

std::vector<Column> Columns(const DisparityPatch& patch, const Box2d& box, const std::vector<Box2d>& hidden_by,
                            const StereoCamera& camera, const GroundPlane& ground, const ScanRules& rules) {
  const Camera& left = camera.left;
  const double bf = camera.baseline_m * left.fx;
  const double width = std::max((box.right - box.left) / rules.columns, 2.);
  std::vector<Column> columns(static_cast<std::size_t>((box.right - box.left) / width) + 1);
  for (int y = 0; y < patch.values.rows; ++y) {
    const float* row = patch.values.ptr<float>(y);
    const double v = patch.y0 + patch.step_y * y;
    if (v < box.top || v > box.bottom) continue;
    for (int x = 0; x < patch.values.cols; ++x) {
      const double u = patch.x0 + patch.step_x * x;
      if (!(row[x] > 0) || u < box.left || u > box.right) continue;
      const double z = bf / row[x];
      const double height = ground.HeightOf(z * Vec3((u - left.cx) / left.fx, (v - left.cy) / left.fy, 1));
      if (height < rules.low_m || height > rules.high_m || Covers(hidden_by, u, v)) continue;
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
  constexpr std::size_t kFewest = 4;  // pixels in a column
  std::vector<Weighed> medians;
  for (Column& column : columns) {
    if (column.disparities.size() < kFewest) continue;
    const double pixels = static_cast<double>(column.disparities.size());
    const double disparity = Median(column.disparities);
    medians.push_back({{column.u_sum / pixels, column.v_sum / pixels, disparity}, bf / disparity, pixels});
  }
  return medians;
}

}  // namespace

std::vector<ScanPoint> ScanObject(const DisparityPatch& patch, const Box2d& box, const std::vector<Box2d>& nearer,
                                  const StereoCamera& camera, const GroundPlane& ground, const ScanRules& rules) {
  constexpr double kEnough = 0.15;  // of the columns
  const double bf = camera.baseline_m * camera.left.fx;
  std::vector<Weighed> all = Medians(Columns(patch, box, nearer, camera, ground, rules), bf);
  if (!nearer.empty() && static_cast<double>(all.size()) < kEnough * rules.columns)
    all = Medians(Columns(patch, box, {}, camera, ground, rules), bf);
  // The stretch of depth that holds most pixels is the object.
  double most = 0, nearest = 0;
  for (const Weighed& start : all) {
    double pixels = 0;
    for (const Weighed& other : all) {
      if (other.depth >= start.depth && other.depth <= start.depth + rules.depth_m) pixels += other.pixels;
    }
    if (pixels <= most) continue;
    most = pixels;
    nearest = start.depth;
  }
  std::vector<ScanPoint> points;
  for (const Weighed& candidate : all) {
    if (candidate.depth >= nearest && candidate.depth <= nearest + rules.depth_m) points.push_back(candidate.point);
  }
  return points;
}

}  // namespace sslcd
