// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "odometry/odometry_noise.h"
#include "sslcd/bundle/options.h"
#include "sslcd/core/detection_noise.h"
#include "sslcd/core/label.h"
#include "sslcd/core/pose.h"

namespace sslcd {

struct BaCamera {
  int frame = 0;
  Pose T_world_cam;
};

struct BaObject {
  int id = 0;
  Symmetry symmetry = Symmetry::kNone;
  UprightPose pose;
};

/// Object `object` was seen from camera `camera` (indices into the problem's lists).
struct BaSighting {
  int camera = 0, object = 0;
  Pose T_cam_object;
};

/// Odometry between two cameras, translation as measured (before scaling).
struct BaOdometry {
  int from = 0, to = 0;
  Pose T_from_to;
};

/// Two cameras whose place to each other was measured otherwise, e.g. from their images. It may be
/// wrong (Cauchy loss).
struct BaTie {
  int from = 0, to = 0;  ///< indices of cameras; the same twice says nothing
  RelativePose pose;     ///< T_from_to, metric
};

/// What is known of the remaining states once others have been marginalised: 0.5 |r0 + J (x -
/// x0)|^2. The state order is cameras (6 each, tangent at x0), objects (4 each), log scale (1).
struct BaPrior {
  std::vector<int> frames, object_ids;  ///< whose states it talks about, by name
  std::vector<Pose> cameras;            ///< x0
  std::vector<UprightPose> objects;     ///< x0
  double log_scale = 0;                 ///< x0
  Eigen::MatrixXd J;
  Eigen::VectorXd r0;
  bool empty() const { return J.rows() == 0; }
};

/// What is known of a vehicle's road: how steep it is, and that elsewhere it is steep otherwise.
/// Nothing else holds the roll and pitch of an odometry that does not measure gravity, and with
/// them its height, between the ends of a loop.
struct SlopePrior {
  double sigma_rad = 0;   ///< standard deviation of the slope; 0: nothing is known
  double length_m = 200;  ///< of path, after which the slope is another one
};

struct BaProblem {
  GravityFrame gravity;
  std::vector<BaCamera> cameras;
  std::vector<BaObject> objects;
  std::vector<BaSighting> sightings;
  std::vector<BaOdometry> odometry;
  std::vector<BaTie> ties;
  double log_scale = 0;
  double expected_log_scale = 0;  ///< mean of the scale's prior, where `prior` is empty
  BaPrior prior;                  ///< empty: the first camera and the scale get their own
  /// Holds the first camera where it is, also where there is a prior: what is left of a long way
  /// says next to nothing about where in the world all of it is.
  bool hold_first = false;
  DetectionNoise noise;
  NoiseScale noise_scale;
  OdometryFactors odometry_factors;  ///< on BaOptions::odometry
  /// The first camera, which stands on a slope like all others, tells which direction of the
  /// cameras is up.
  SlopePrior slope;
};

/// Eq. 7: moves cameras, objects and scale to the minimum. Deterministic for any thread count.
/// Never throws on odd geometry: a problem without sightings and ties, or with non-finite input
/// comes back unchanged with `usable` false.
BaSummary SolveBa(BaProblem& problem, const BaOptions& options);

/// The prior that replaces the given cameras and objects (sorted indices) and every residual that
/// touches them, linearised where the problem stands (Schur complement). Objects not named must not
/// be seen from a dropped camera only.
BaPrior Marginalise(const BaProblem& problem, const std::vector<int>& cameras,
                    const std::vector<int>& objects, const BaOptions& options);

/// Factor between the detector's real scatter about the map and `problem.noise`, per component,
/// from the median of the absolute residuals. Keeps the present scale where there are fewer than 20
/// residuals.
NoiseScale EstimateNoiseScale(const BaProblem& problem);

}  // namespace sslcd
