// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sslcd/core/camera.h"
#include "sslcd/io/dataset.h"
#include "sslcd/stereo/rig_check.h"

namespace sslcd::apps {

/// Left and right image file of each frame; empty where it has none.
using StereoFiles = std::vector<std::pair<std::string, std::string>>;
StereoFiles StereoFilesOf(const Dataset& dataset);

/// MakeStereoCamera of a dataset that has both cameras; errors name it.
StereoCamera StereoCameraOf(const Dataset& dataset);

/// How far off the camera's calibration is, by these images (CheckRig), and says so to people. What
/// is wrong with the images is told by those who use them. Nothing more is looked at after an
/// interrupt.
RigCheck CheckRigOf(const StereoFiles& files, const StereoCamera& camera,
                    const StereoOdometryOptions& options);

/// Where two cameras should look for AlignGround (SpotAhead, by the first left image). None: no
/// image can be read, or it shows no near ground.
std::optional<double> SpotAheadOf(const StereoFiles& files, const Camera& camera, double height_m);

}  // namespace sslcd::apps
