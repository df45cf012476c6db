// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/formats/poses.h"

#include <cmath>

#include "formats/number_text.h"
#include "formats/pose_text.h"
#include "formats/rigid.h"
#include "formats/text_rows.h"

namespace sslcd {
namespace {

PoseFormat Guess(const TextRows& row) {
  if (row.has_commas() && row.size() >= 8) return PoseFormat::kVinsCsv;
  if (!row.has_commas() && row.size() == 12) return PoseFormat::kKitti;
  if (!row.has_commas() && row.size() == 8) return PoseFormat::kTum;
  row.Fail("not a pose row: found " + std::to_string(row.size()) +
           " columns, expected 8 (TUM: t x y z qx qy qz qw), 12 (KITTI: 3x4 matrix) or a "
           "VINS-Fusion csv");
}

Pose PoseFromKitti(const TextRows& row) {
  Eigen::Matrix<double, 3, 4> M;
  for (int i = 0; i < 12; ++i) M(i / 4, i % 4) = row.Number(i);
  const std::optional<Pose> pose = RigidFromMatrix(M.leftCols<3>(), M.col(3));
  if (!pose)
    row.Fail(
        "the 3x4 matrix is not a rigid transform (NaN, mirrored, or R^T R is not the identity): "
        "correct "
        "the row");
  return *pose;
}

/// `w` is the column of qw: after or before qx qy qz.
Pose PoseFromQuaternion(const TextRows& row, int w) {
  const int x = w == 7 ? 4 : 5;
  const Vec3 t(row.Number(1), row.Number(2), row.Number(3));
  const Eigen::Quaterniond q(row.Number(w), row.Number(x), row.Number(x + 1), row.Number(x + 2));
  if (!t.allFinite() || !(std::abs(q.norm() - 1) <= kRotationTolerance)) {
    row.Fail(
        "the pose is not finite or its quaternion is not of unit length: correct the row, or check "
        "the "
        "column order");
  }
  return Pose::FromQuaternionTranslation(q, t);
}

void CheckIncreasing(const TextRows& row, const Trajectory& trajectory, double stamp) {
  if (!std::isfinite(stamp)) row.Fail("the stamp is not finite");
  if (!trajectory.stamps.empty() && !(stamp > trajectory.stamps.back())) {
    row.Fail("stamp " + std::string(row.Text(0)) +
             " does not come after the one before: stamps must increase");
  }
}

}  // namespace

const char* ToString(PoseFormat format) {
  switch (format) {
    case PoseFormat::kAuto: return "auto";
    case PoseFormat::kTum: return "tum";
    case PoseFormat::kKitti: return "kitti";
    case PoseFormat::kVinsCsv: return "vins-csv";
  }
  return "";
}

PoseFile ReadPoseFile(const std::string& path, PoseFormat format) {
  PoseFile file{format, {}};
  std::vector<double>& stamps = file.trajectory.stamps;
  std::size_t columns = 0;
  TextRows row(path);
  while (row.Next()) {
    if (file.format == PoseFormat::kAuto) file.format = Guess(row);
    if (columns == 0)
      columns = file.format == PoseFormat::kTum     ? 8
                : file.format == PoseFormat::kKitti ? 12
                                                    : row.size();
    if (row.size() != columns || columns < 8) {
      row.Fail("found " + std::to_string(row.size()) + " columns, expected " +
               std::to_string(std::max<std::size_t>(columns, 8)) + " (format " +
               ToString(file.format) + ")");
    }
    Pose pose;
    double stamp = static_cast<double>(stamps.size());
    if (file.format == PoseFormat::kKitti) {
      pose = PoseFromKitti(row);
    } else {
      stamp = row.Number(0) * (file.format == PoseFormat::kVinsCsv ? 1e-9 : 1.);
      pose = PoseFromQuaternion(row, file.format == PoseFormat::kVinsCsv ? 4 : 7);
      CheckIncreasing(row, file.trajectory, stamp);
    }
    stamps.push_back(stamp);
    file.trajectory.poses.push_back(pose);
  }
  return file;
}

Trajectory ReadTrajectory(const std::string& path, PoseFormat format) {
  return ReadPoseFile(path, format).trajectory;
}

std::string TumText(const Trajectory& trajectory) {
  std::string text;
  for (std::size_t i = 0; i < trajectory.size(); ++i)
    text += FixedNumber(trajectory.stamps[i], 9) + " " + PoseText(trajectory.poses[i]) + "\n";
  return text;
}

std::string KittiText(const Trajectory& trajectory) {
  std::string text;
  for (const Pose& T : trajectory.poses) {
    const auto M = T.matrix3x4();
    for (int i = 0; i < 12; ++i) text += FixedNumber(M(i / 4, i % 4), 9) + (i < 11 ? " " : "\n");
  }
  return text;
}

}  // namespace sslcd
