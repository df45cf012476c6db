// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/formats/poses.h"

#include <cmath>

#include "formats/number_text.h"
#include "formats/pose_text.h"
#include "formats/text_rows.h"

namespace sslcd {
namespace {

// Columns of a TUM row with two standard deviations.
constexpr std::size_t kMostTum = 10;

PoseFormat Guess(const TextRows& row) {
  if (row.has_commas() && row.size() >= 8) return PoseFormat::kVinsCsv;
  if (!row.has_commas() && row.size() == 12) return PoseFormat::kKitti;
  if (!row.has_commas() && row.size() >= 8 && row.size() <= kMostTum) return PoseFormat::kTum;
  row.Fail("not a pose row: found " + std::to_string(row.size()) +
           " columns, expected 8 (TUM: t x y z qx qy qz qw), 12 (KITTI: 3x4 matrix) or a "
           "VINS-Fusion csv");
}

// `columns`: those of the first row.
void CheckColumns(const TextRows& row, PoseFormat format, std::size_t columns) {
  const bool tum = format == PoseFormat::kTum;
  if (tum ? row.size() >= 8 && row.size() <= kMostTum : row.size() == columns && columns >= 8)
    return;
  row.Fail("found " + std::to_string(row.size()) + " columns, expected " +
           std::to_string(tum ? 8 : std::max<std::size_t>(columns, 8)) + " (format " +
           ToString(format) + ")" +
           (tum ? ", and after them nothing, two standard deviations, or 'lost'" : ""));
}

// What a TUM row says of the step to it.
std::optional<StepUncertainty> StepOf(const TextRows& row) {
  if (row.size() == 8) return std::nullopt;
  StepUncertainty step;
  step.lost = row.size() == 9 && row.Text(8) == "lost";
  if (step.lost) return step;
  if (row.size() == 9)
    row.Fail("column 9: found '" + std::string(row.Text(8)) +
             "', expected 'lost', or the standard deviations of the step's translation [m] and "
             "rotation [rad] in columns 9 and 10");
  step.translation_m = row.Number(8);
  step.rotation_rad = row.Number(9);
  if (!IsValid(step))
    row.Fail(
        "columns 9 and 10: a standard deviation is negative or not finite: correct it, or "
        "write 'lost' in place of both where the step is unknown");
  return step;
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
  PoseFile file;
  file.format = format;
  std::vector<double>& stamps = file.trajectory.stamps;
  std::size_t columns = 0;
  TextRows row(path);
  while (row.Next()) {
    if (file.format == PoseFormat::kAuto) file.format = Guess(row);
    if (columns == 0) columns = file.format == PoseFormat::kKitti ? 12 : row.size();
    CheckColumns(row, file.format, columns);
    Pose pose;
    std::optional<StepUncertainty> step;
    double stamp = static_cast<double>(stamps.size());
    if (file.format == PoseFormat::kKitti) {
      pose = PoseFromKitti(row);
    } else {
      stamp = row.Number(0) * (file.format == PoseFormat::kVinsCsv ? 1e-9 : 1.);
      pose = PoseFromQuaternion(row, file.format == PoseFormat::kVinsCsv ? 4 : 7);
      CheckIncreasing(row, file.trajectory, stamp);
      if (file.format == PoseFormat::kTum) step = StepOf(row);
    }
    stamps.push_back(stamp);
    file.trajectory.poses.push_back(pose);
    file.steps.push_back(step);
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
