// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sslcd/core/camera.h"
#include "sslcd/core/detection.h"
#include "sslcd/core/label.h"
#include "sslcd/core/pose.h"
#include "sslcd/datasets/dataset.h"

namespace sslcd {

/// A drive with its true poses.
struct Session {
  std::vector<Frame> frames;
  std::vector<Pose> truth;
  bool copy = false;  // of another place
};

/// Path length of each frame, by odometry. [m]
std::vector<double> PathOf(const Session& session);

/// A dataset with ground truth as one session: each frame with the true pose that is nearest in
/// time.
Session WithTruth(const Dataset& data);

/// HALV-sim, recorded twice: the second session is the way back, with other noise and a share of
/// `churn` of the cars replaced. The copy has the layout of the first with cars that look
/// different.
struct TwoVisits {
  GravityFrame gravity;
  LabelTable labels;
  std::optional<Camera> camera;
  Session first, copy, second;
};
TwoVisits RecordHalvTwice(int halv_case, const std::string& layout, std::uint64_t seed,
                          double churn);

/// Turns the odometry of a session so that its first camera is as level as that of the drive.
void StartUpright(const Vec3& up, const Pose& first_of_drive, Session& session);

}  // namespace sslcd
