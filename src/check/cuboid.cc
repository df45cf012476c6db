// SPDX-License-Identifier: BSD-3-Clause
#include "check/cuboid.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/median.h"
#include "perception/projection.h"

namespace sslcd::check {
namespace {

constexpr double kUnknownShare = 0.9;  // of rows with one and the same alpha
constexpr int kMostRows = 1000;
constexpr double kNearPlane = 0.5;  // [m] in front of the camera
constexpr double kBorder = 2;       // [px] boxes that end here are cut

/// Whether a box is cut by the image, or may be where its size is unknown.
bool IsCut(const Box2d& box, const Camera& camera) {
  if (camera.width == 0) return box.left < kBorder || box.top < kBorder;
  return box.left < kBorder || box.top < kBorder || box.right > camera.width - kBorder ||
         box.bottom > camera.height - kBorder;
}

}  // namespace

FileCuboid ReadCuboid(const Detection& detection) {
  FileCuboid cuboid;
  cuboid.l = detection.dims.x();
  cuboid.w = detection.dims.y();
  cuboid.h = detection.dims.z();
  cuboid.bottom = detection.T_cam_object.translation() + Vec3(0, 0.5 * cuboid.h, 0);
  cuboid.rotation_y = -GravityFrame().YawOf(detection.T_cam_object.so3());
  return cuboid;
}

void WriteCuboid(const FileCuboid& cuboid, Row& row) {
  const GravityFrame camera;  // up = -y
  row.detection.dims = Vec3(cuboid.l, cuboid.w, cuboid.h);
  row.detection.T_cam_object =
      Pose(camera.Upright(-cuboid.rotation_y), cuboid.bottom - Vec3(0, 0.5 * cuboid.h, 0));
  row.written.rotation_y = cuboid.rotation_y;
}

double Bearing(const Detection& detection) {
  const Vec3& centre = detection.T_cam_object.translation();
  return std::atan2(centre.x(), centre.z());
}

bool HasHeading(const Sequence& sequence, const Row& row) {
  return sequence.labels[row.detection.label].symmetry != Symmetry::kFull;
}

bool HasAlphas(const Sequence& sequence) {
  std::map<double, int> counts;
  for (const Row& row : sequence.rows) ++counts[row.written.alpha];
  return std::none_of(counts.begin(), counts.end(), [&](const auto& count) {
    return count.second > kUnknownShare * static_cast<double>(sequence.rows.size());
  });
}

std::optional<double> MedianIou(const Sequence& sequence, const CuboidChange& change) {
  if (!sequence.camera) return std::nullopt;
  const std::size_t stride = 1 + sequence.rows.size() / kMostRows;
  std::vector<double> ious;
  for (std::size_t i = 0; i < sequence.rows.size(); i += stride) {
    if (!(sequence.rows[i].detection.T_cam_object.translation().z() > kNearPlane)) continue;
    Row row = sequence.rows[i];
    Camera camera = *sequence.camera;
    if (change) change(row, camera);
    if (!row.detection.box || IsCut(*row.detection.box, camera)) continue;
    const auto box = ProjectCuboid(row.detection.T_cam_object, row.detection.dims, camera);
    ious.push_back(box ? Iou(*box, *row.detection.box) : 0);
  }
  if (static_cast<int>(ious.size()) < kLeastBoxes) return std::nullopt;
  return Median(std::move(ious));
}

}  // namespace sslcd::check
