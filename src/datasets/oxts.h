// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "formats/calib.h"
#include "sslcd/core/pose.h"

namespace sslcd {

/// Poses T_first_imu of KITTI's GPS/IMU packets (30 columns: lat lon alt roll pitch yaw ...), by
/// the Mercator projection of the KITTI devkit. `path` is a file with one packet per row (KITTI
/// tracking) or a folder with one packet per file (raw drives). Throws Error with file:line for
/// malformed packets, and Error with the number of a missing packet.
std::vector<Pose> ReadOxts(const std::string& path);

/// The same poses for the rectified camera 0, relative to its first pose: T_first_cam. Throws Error
/// if the calibration lacks the transform from IMU to camera.
std::vector<Pose> ReadOxtsCamera(const std::string& path, const Calibration& calibration);

/// Stamps of a raw drive's timestamps.txt (rows "2011-09-26 13:02:25.964389445") relative to the
/// first one. [s]
std::vector<double> ReadTimestamps(const std::string& path);

}  // namespace sslcd
