// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "sslcd/core/camera.h"

namespace sslcd {

/// The pair of cameras of a KITTI-style rig that is used.
enum class CameraPair {
  kColour,  ///< P2 and P3
  kGrey,    ///< P0 and P1, else those
};

/// Calibration of a KITTI-style rig. `cam` is the rectified camera 0, the frame that labels and
/// projections are given in.
struct Calibration {
  std::optional<Camera> left;
  std::optional<Camera> right;
  std::optional<Pose> T_cam_velo;  ///< lidar -> rectified camera 0
  std::optional<Pose> T_velo_imu;

  /// Both of the above are known.
  bool HasImu() const { return T_cam_velo && T_velo_imu; }
};

/// Reads calib.txt of KITTI odometry, tracking or object, with or without colons after the keys, or
/// a raw drive's calib_cam_to_cam.txt (P_rect_02, S_rect_02; no T_cam_velo in there). Where no row
/// has a key they are P0, P1, ... The image size is known from S_rect_02 only. Throws Error with
/// file:line when the left camera is missing, naming the keys found, or when an entry is no
/// projection or rotation.
Calibration ReadCalibration(const std::string& path, CameraPair pair = CameraPair::kColour);

/// Reads a raw drive's folder of calib_cam_to_cam.txt, calib_velo_to_cam.txt,
/// calib_imu_to_velo.txt; the latter two may be missing.
Calibration ReadRawCalibration(const std::string& folder);

/// calib.txt of KITTI odometry: P0 and P1 without the left camera's offset, P2 and P3 with it.
std::string CalibrationText(const StereoCamera& stereo);

}  // namespace sslcd
