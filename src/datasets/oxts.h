// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "formats/calib.h"
#include "sslcd/core/pose.h"

namespace sslcd {

/// Poses T_first_imu of KITTI's GPS/IMU packets (30 columns: lat lon alt roll pitch yaw ...), by
/// the Mercator projection of the KITTI devkit. `path` is a file with one packet a row (KITTI
/// tracking) or a folder with one a file (raw drives). Throws Error with file:line for malformed
/// packets and naming the number of a packet that is missing in a folder.
std::vector<Pose> ReadOxts(const std::string& path);

/// The same poses of the rectified camera 0, with respect to its first: T_cam0_cam.
/// Throws Error when the calibration lacks the way from IMU to camera.
std::vector<Pose> ReadOxtsCamera(const std::string& path, const Calibration& calibration);

/// Stamps of a raw drive's timestamps.txt ("2011-09-26 13:02:25.964389445" a row) relative to the
/// first. [s]
std::vector<double> ReadTimestamps(const std::string& path);

}  // namespace sslcd
