// SPDX-License-Identifier: BSD-3-Clause
// VINS's configuration files, through OpenCV as VINS reads them.
#pragma once

#include <string>
#include <vector>

#include "rig.h"

namespace sslcd::vins {

struct VinsConfig {
  Rig rig;
  /// `sslcd_detections`: a sequence folder, see DetectionFolder; relative to the file. Empty: none.
  std::string detections;
  std::vector<std::string> notes;  ///< what a user may want to know, a sentence each
};

/// Reads `imu`, `body_T_cam0` and `cam0_calib` of VINS-Fusion's YAML. A camera that is no pinhole
/// or has distortion is left out, with a note: then boxes in the image are not used. Throws
/// Error(kBadInput).
VinsConfig ReadVinsConfig(const std::string& path);

}  // namespace sslcd::vins
