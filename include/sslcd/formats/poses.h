// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sslcd/core/export.h"
#include "sslcd/core/pose.h"

namespace SSLCD_EXPORT sslcd {

/// The format of a pose file, one pose per row.
enum class PoseFormat {
  kAuto,     ///< from the first row: 12 columns, 8 to 10 columns, or commas
  kTum,      ///< t[s] x y z qx qy qz qw [step: sigma_translation[m] sigma_rotation[rad] | lost]
  kKitti,    ///< 3x4 matrix [R t], row by row; no stamps
  kVinsCsv,  ///< t[ns],x,y,z,qw,qx,qy,qz[,anything]: VINS-Fusion's vio.csv and vio_loop.csv,
             ///< EuRoC's ground truth
};

/// "auto", "tum", "kitti", "vins-csv".
const char* ToString(PoseFormat format);

struct PoseFile {
  PoseFormat format = PoseFormat::kAuto;  ///< the detected format; kAuto only if the file is empty
  /// for kKitti the stamps are the row numbers 0, 1, 2, ...
  Trajectory trajectory;
  /// of each pose: what its row reports of the step from the row before; only kTum can
  std::vector<std::optional<StepUncertainty>> steps;
};

/// Reads the poses unchanged; the caller must know their frame (VINS-Fusion writes poses of its
/// body). Normalises quaternions whose length is within 1e-2 of 1 and matrices that are within 1e-2
/// of a rotation. Throws Error with file:line for larger errors, NaN, a wrong number of columns, a
/// malformed number, a negative standard deviation and stamps that do not increase. An empty file
/// is an empty trajectory.
PoseFile ReadPoseFile(const std::string& path, PoseFormat format = PoseFormat::kAuto);

/// Only the trajectory.
Trajectory ReadTrajectory(const std::string& path, PoseFormat format = PoseFormat::kAuto);

/// Returns the text of a PoseFormat::kTum file for evo: single blanks, no trailing blank, qw >= 0.
std::string TumText(const Trajectory& trajectory);
/// Returns the text of a PoseFormat::kKitti file.
std::string KittiText(const Trajectory& trajectory);

}  // namespace sslcd
