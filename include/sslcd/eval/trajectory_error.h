// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "sslcd/core/pose.h"

namespace sslcd {

/// What may be moved before an estimate is compared with the reference.
enum class Alignment {
  kNone,  ///< nothing
  k4Dof,  ///< translation and yaw about the vertical
  kSe3,   ///< translation and rotation
  kSim3,  ///< translation, rotation and one scale
};

/// "none", "4dof", "se3" or "sim3".
const char* ToString(Alignment alignment);
/// Throws Error (kUsage) with the list of names.
Alignment ParseAlignment(const std::string& text);

/// x_ref = scale * R * x_est + t.
struct Similarity {
  double scale = 1;
  Pose T_ref_est;

  Vec3 operator*(const Vec3& p) const {
    return scale * (T_ref_est.so3() * p) + T_ref_est.translation();
  }
  Pose operator*(const Pose& T_est_cam) const {
    return Pose(T_ref_est.so3() * T_est_cam.so3(), *this * T_est_cam.translation());
  }
};

/// Statistics of a list of errors, in the errors' unit. `std` is that of the population (divided by
/// n), as in evo.
struct ErrorStats {
  double rmse = 0, mean = 0, median = 0, std = 0, max = 0;
  int count = 0;  ///< 0: everything else is 0 too
};
ErrorStats Summarise(std::vector<double> errors);

/// Poses of two trajectories that belong together: `est[i]` and `ref[i]` are of the same moment.
struct MatchedPoses {
  std::vector<Pose> est, ref;
};

/// Pairs the poses as evo does: for every pose of the trajectory with fewer poses (of `est` on a
/// tie) the nearest in time of the other one, if it is no further than `max_difference_s`. Throws
/// Error: stamps that are not finite or go backwards, as many stamps as poses not given
/// (kBadInput), no match at all (kNoSolution).
MatchedPoses MatchByStamp(const Trajectory& est, const Trajectory& ref,
                          double max_difference_s = 0.01);

/// The motion that minimises sum |S * est_i - ref_i|^2 over the positions, in closed form. `up` is
/// the vertical of both worlds and matters for k4Dof only. Sources: Umeyama, Least-squares
/// estimation of transformation parameters between two point patterns, PAMI 1991 (SE(3), Sim(3));
/// its planar case about `up` (4 DoF). Where the positions leave a rotation open (fewer than three,
/// or on one line) any of the best is returned; a scale that is left open (all positions of `est`
/// equal) is 1. The errors after alignment are the same for all of them.
Similarity Align(const std::vector<Pose>& est, const std::vector<Pose>& ref, Alignment alignment,
                 const Vec3& up = Vec3(0, -1, 0));

/// Absolute trajectory error: distances of positions after alignment. [m]
struct AteResult {
  ErrorStats error;
  Alignment alignment = Alignment::kNone;
  Similarity S_ref_est;
  /// false: the positions leave part of the alignment open, see Align()
  bool unique = true;
  std::vector<double> errors;  ///< per pose
};

/// Equal to evo_ape's (`evo_ape` none, `-a` SE(3), `-as` Sim(3)), except that evo refuses positions
/// on one line. Throws Error (kBadInput): no poses, lists of different length, a value that is not
/// finite.
AteResult ComputeAte(const std::vector<Pose>& est, const std::vector<Pose>& ref,
                     Alignment alignment = Alignment::kSe3, const Vec3& up = Vec3(0, -1, 0));

/// Which pairs of poses a relative error is taken over.
enum class DeltaUnit { kFrames, kMetres };
struct RpeOptions {
  double delta = 1;  ///< > 0; a whole number of frames, or metres along the estimated path
  DeltaUnit unit = DeltaUnit::kFrames;
  /// overlapping pairs from every pose; in metres: those within 10 % of delta, as in evo
  bool all_pairs = false;
};

/// Relative pose error: (Q_i^-1 Q_j)^-1 (P_i^-1 P_j) with the reference Q and the estimate P.
struct RpeResult {
  ErrorStats translation;   ///< [m]
  ErrorStats rotation_rad;  ///< angle of the rotation [rad]
};

/// Equal to evo_rpe's (`-d delta -u f|m [--all_pairs]`, `-r trans_part` and `-r angle_rad`). No
/// pair: counts of 0. Throws Error as ComputeAte does, and kUsage for a delta that is not positive
/// or not a whole number of frames.
RpeResult ComputeRpe(const std::vector<Pose>& est, const std::vector<Pose>& ref,
                     const RpeOptions& options = {});

}  // namespace sslcd
