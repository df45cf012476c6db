// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/visual_odometry/odometry.h"

#include <algorithm>
#include <cmath>

namespace sslcd {

void DescribeFields(FieldVisitor& v, StereoOdometryOptions& o) {
  v.Everyday("more: less drift, and slower")
      .Integer("points", o.points, 50, 5000, "image points followed, spread over the image");
  v.Integer("window", o.window, 3, 50,
            "keyframes adjusted together; the oldest two are held fixed");
  v.Flag("calibrate", o.calibrate,
         "estimate the disparity at infinity before the run where the rows of left and right "
         "images show that calibration is off");
}

OdometryNoise StereoOdometryNoise(std::optional<double> row_error_rad) {
  // Measured on HALV-sim, rendered (ideal), and KITTI 02 and 06 (real): docs/notes, "Which
  // noise?".
  constexpr double kIdealWalk = 1e-4, kRealWalk = 5e-4;  // heading [rad per sqrt(m)]
  // On KITTI the random walk of the heading equals the row error; twice that is conservative.
  constexpr double kRowFactor = 2;
  constexpr double kRotationFloor = 1e-4;     // [rad] of a step
  constexpr double kTranslationFloor = 1e-3;  // [m] of a step
  constexpr double kRealTurn = 2e-3;          // [rad per rad turned]
  constexpr double kRealTranslation = 5e-3;   // [m per sqrt(m)]
  constexpr double kLeastTranslation = 2e-3;  // [m per sqrt(m)] twice the value of ideal images
  OdometryNoise noise;
  noise.rotation_walk =
      row_error_rad ? std::min(kRealWalk, std::hypot(kIdealWalk, kRowFactor * *row_error_rad))
                    : kRealWalk;
  const double share = noise.rotation_walk / kRealWalk;
  noise.rotation_floor_rad = kRotationFloor;
  noise.rotation_turn = share * kRealTurn;
  noise.translation_floor_m = kTranslationFloor;
  noise.translation_walk = std::max(kLeastTranslation, share * kRealTranslation);
  noise.vertical_walk = noise.translation_walk;
  return noise;
}

const char* ToString(OdometryStatus status) {
  constexpr const char* kNames[] = {"first", "tracked", "lost"};
  return kNames[static_cast<int>(status)];
}

}  // namespace sslcd
