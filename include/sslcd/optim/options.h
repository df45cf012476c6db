// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "sslcd/core/fields.h"
#include "sslcd/core/pose.h"

namespace sslcd {

/// How far the odometry is off: a random walk, so variances grow with the distance d between two
/// frames, and a share of each turn a: var = floor^2 + walk^2 d (+ turn^2 a^2 for rotations).
/// Height has a walk of its own: slowly pitching cameras and uneven roads make it drift further
/// than the way on the ground.
struct OdometryNoise {
  double translation_floor_m = 0.003;
  double translation_walk = 0.01;  ///< horizontal [m per sqrt(m)]
  double vertical_walk = 0.01;     ///< [m per sqrt(m)]
  double rotation_floor_rad = 2e-4;
  double rotation_walk = 5e-4;  ///< [rad per sqrt(m)]
  double rotation_turn = 2e-3;  ///< [rad per rad turned]
  double scale_prior = 0.05;    ///< standard deviation of the log scale; 0 keeps the scale at one
};
void DescribeFields(FieldVisitor& visitor, OdometryNoise& noise);

/// Object bundle adjustment, paper III-C.
struct BaOptions {
  enum class Residual { kRobust, kPaper };
  enum class Solver { kLevenbergMarquardt, kGaussNewton };
  Residual residual = Residual::kRobust;
  Solver solver = Solver::kLevenbergMarquardt;
  int max_iterations = 30;
  double loss_scale = 3.;  ///< robust: a Cauchy loss on each sighting's whitened residual; 0: none
  /// robust: factor on detection sigmas, because errors of successive frames are alike
  double correlation = 2.;
  OdometryNoise odometry;
};
void DescribeFields(FieldVisitor& visitor, BaOptions& options);

/// What a bundle adjustment did.
struct BaSummary {
  bool usable = false;  ///< false: the problem is left as it was
  bool converged = false;
  int iterations = 0;
  double initial_cost = 0, final_cost = 0;
  std::string message;  ///< one line
};

/// How matched objects are aligned, paper IV-D.
struct DriftOptions {
  bool six_dof = true;           ///< also correct roll and pitch; false: yaw and shift only
  double tilt_sigma_rad = 0.03;  ///< standard deviation of the local map's vertical
  /// scale of the Cauchy loss on each pair's position and heading, in sigmas; 0: none
  double loss_scale = 2.;
  int max_iterations = 30;  ///< of Gauss-Newton, at most; no key: a test raises it
};
void DescribeFields(FieldVisitor& visitor, DriftOptions& options);

/// What a vertex may do.
enum class PoseFreedom {
  kFull,     ///< 6 DoF
  kUpright,  ///< 4 DoF: translation and yaw about `up`. Roll and pitch are known (gravity) and stay
             ///< as they are; of a measured rotation only the yaw counts
  kPlanar,   ///< 3 DoF: as kUpright, and the height stays as it is
};

/// Where the optimisation starts.
enum class PoseGraphStart {
  kAuto,     ///< from the given poses; or chordal, where these are far from the measurements and
             ///< chordal is nearer
  kGiven,    ///< from the given poses
  kChordal,  ///< rotations from the chordal relaxation (Carlone et al., ICRA 2015), then linear
             ///< translations
};

/// Pose graph optimisation, paper IV-D Eqs. 20, 21.
struct PoseGraphOptions {
  PoseFreedom freedom = PoseFreedom::kFull;
  PoseGraphStart start = PoseGraphStart::kAuto;  ///< no key: callers that know better set it
  int max_iterations = 100;                      ///< no key: of one solve
  /// no key: the solver stops when an iteration lowers chi2 by a smaller fraction
  double tolerance = 1e-6;
  GravityFrame gravity;  ///< which way is up; for kUpright and kPlanar
};
void DescribeFields(FieldVisitor& visitor, PoseGraphOptions& options);

/// Graduated non-convexity with truncated least squares (GNC-TLS; Yang et al., RA-L 2020) over the
/// loop edges. Edges that are no loops are always trusted.
struct RobustPoseGraphOptions {
  PoseGraphOptions graph;
  /// a true loop is kept with this probability: sets the chi2 limit
  double inlier_probability = 0.99;
  /// a loop that would need odometry errors this many times larger than expected is refused at
  /// first; it comes back only if the other loops lead to it
  double drift_factor = 3.;
  /// no key: factor from one weight update to the next, by which the cost turns from convex to
  /// truncated. Yang et al. 2020 use 1.4, too.
  double mu_factor = 1.4;
};
void DescribeFields(FieldVisitor& visitor, RobustPoseGraphOptions& options);

}  // namespace sslcd
