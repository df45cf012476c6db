// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "sslcd/core/camera.h"

namespace sslcd {

/// The camera pair of a KITTI-style rig to use.
enum class CameraPair {
  kColour,  ///< P2 and P3
  kGrey,    ///< P0 and P1 (P_rect_00, P_rect_01); if the file lacks them, P2 and P3
};

/// Calibration of a KITTI-style rig. `cam` is the rectified camera 0, the frame of labels and
/// projections.
struct Calibration {
  std::optional<Camera> left;
  std::optional<Camera> right;
  std::optional<Pose> T_cam_velo;  ///< lidar -> rectified camera 0
  std::optional<Pose> T_velo_imu;

  /// True if the transform from IMU to camera is known.
  bool HasImu() const { return T_cam_velo && T_velo_imu; }
};

/// Reads calib.txt of KITTI odometry, tracking or object, with or without colons after the keys, or
/// a raw drive's calib_cam_to_cam.txt (P_rect_02, S_rect_02; no T_cam_velo in there). If no row has
/// a key, the rows are P0, P1, ... Only S_rect_02 gives the image size. Throws Error with file:line
/// and the keys found if the left camera is missing, or if an entry is not a projection or
/// rotation.
Calibration ReadCalibration(const std::string& path, CameraPair pair = CameraPair::kColour);

/// Reads calib_cam_to_cam.txt, calib_velo_to_cam.txt and calib_imu_to_velo.txt from the folder of a
/// raw drive. The last two files are optional.
Calibration ReadRawCalibration(const std::string& folder, CameraPair pair = CameraPair::kColour);

/// Returns a calib.txt in the format of KITTI odometry: P0 and P1 without the left camera's offset,
/// P2 and P3 with it.
std::string CalibrationText(const StereoCamera& stereo);

}  // namespace sslcd
