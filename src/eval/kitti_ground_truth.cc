// SPDX-License-Identifier: BSD-3-Clause
#include "eval/kitti_ground_truth.h"

#include <cmath>
#include <utility>

#include "formats/text_rows.h"

namespace sslcd {
namespace {

/// KITTI: x right, y down, z forward; rotation_y about +y, zero along x; the location is on the
/// ground.
Pose PoseOfLabel(const Vec3& bottom_centre, double height, double rotation_y) {
  return Pose(GravityFrame().Upright(-rotation_y), bottom_centre - Vec3(0, 0.5 * height, 0));
}

GroundTruthBox ReadRow(const TextRows& row) {
  GroundTruthBox box;
  box.frame = row.Integer(0);
  box.track = row.Integer(1);
  box.label = std::string(row.Text(2));
  if (box.frame < 0) row.Fail("the frame number is negative: frames count from 0");
  double v[7];  // h w l x y z rotation_y
  for (int k = 0; k < 7; ++k) {
    v[k] = row.Number(10 + k);
    if (!std::isfinite(v[k])) row.Fail("the box is not finite: remove the row");
  }
  box.dims = {v[2], v[1], v[0]};
  box.T_cam_object = PoseOfLabel({v[3], v[4], v[5]}, v[0], v[6]);
  return box;
}

}  // namespace

std::vector<GroundTruthBox> ReadKittiTrackingLabels(const std::string& path) {
  std::vector<GroundTruthBox> boxes;
  for (TextRows row(path); row.Next();) {
    if (row.size() != 17 && row.size() != 18) {
      row.Fail("a row of " + std::to_string(row.size()) +
               " columns: KITTI tracking labels have 17 (frame, track, label, ..., rotation_y)");
    }
    GroundTruthBox box = ReadRow(row);
    if (box.label != "DontCare") boxes.push_back(std::move(box));
  }
  return boxes;
}

std::vector<int> ReadLandmarkIds(const std::string& path) {
  std::vector<int> ids;
  for (TextRows row(path); row.Next();) {
    if (row.size() != 1)
      row.Fail("expected one identity a line, got " + std::to_string(row.size()) + " columns");
    ids.push_back(row.Integer(0));
  }
  return ids;
}

}  // namespace sslcd
