// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "sslcd/core/pose.h"

namespace sslcd {

/// How poses are written, one a row.
enum class PoseFormat {
  kAuto,     ///< told by the first row: 12 columns, 8 columns, or commas
  kTum,      ///< t[s] x y z qx qy qz qw
  kKitti,    ///< 3x4 matrix [R t], row by row; no stamps
  kVinsCsv,  ///< t[ns],x,y,z,qw,qx,qy,qz[,anything]: VINS-Fusion's vio.csv and vio_loop.csv,
             ///< EuRoC's ground truth
};

/// "auto", "tum", "kitti", "vins-csv".
const char* ToString(PoseFormat format);

struct PoseFile {
  PoseFormat format = PoseFormat::kAuto;  ///< as found, never kAuto unless the file is empty
  /// for kKitti the stamps are the row numbers 0, 1, 2, ...
  Trajectory trajectory;
};

/// Reads poses as they stand; which frame they are of is for the caller to know (VINS-Fusion writes
/// its body's poses). Quaternions up to 1e-2 off unit length and matrices up to 1e-2 off a rotation
/// are brought back to one. Throws Error with file:line for anything further off, for NaN, a wrong
/// number of columns, a letter in a number, and for stamps that do not increase from row to row. An
/// empty file is an empty trajectory.
PoseFile ReadPoseFile(const std::string& path, PoseFormat format = PoseFormat::kAuto);

/// The same without the format.
Trajectory ReadTrajectory(const std::string& path, PoseFormat format = PoseFormat::kAuto);

/// PoseFormat::kTum, as evo reads it: single blanks, no blank at the end of a row, qw >= 0.
std::string TumText(const Trajectory& trajectory);
/// PoseFormat::kKitti.
std::string KittiText(const Trajectory& trajectory);

}  // namespace sslcd
