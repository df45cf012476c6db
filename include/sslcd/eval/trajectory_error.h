// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "sslcd/core/export.h"
#include "sslcd/core/pose.h"

namespace SSLCD_EXPORT sslcd {

/// The degrees of freedom in which an estimate is aligned before it is compared with the reference.
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

/// The similarity transform x_ref = scale * R * x_est + t.
struct Similarity {
  double scale = 1;  ///< > 0; 1 for all alignments except Sim(3)
  Pose T_ref_est;    ///< R and t

  Vec3 operator*(const Vec3& p) const {
    return scale * (T_ref_est.so3() * p) + T_ref_est.translation();
  }
  Pose operator*(const Pose& T_est_cam) const {
    return Pose(T_ref_est.so3() * T_est_cam.so3(), *this * T_est_cam.translation());
  }
};

/// Statistics of a list of errors, in the unit of the errors. `std` is the population's standard
/// deviation (divided by n), as in evo.
struct ErrorStats {
  double rmse = 0, mean = 0, median = 0, std = 0, max = 0;
  int count = 0;  ///< 0: all statistics are 0
};
/// Computes the statistics of a list of errors.
ErrorStats Summarise(std::vector<double> errors);

/// Associated poses of two trajectories: `est[i]` and `ref[i]` have the same time.
struct MatchedPoses {
  std::vector<Pose> est, ref;
};

/// Pairs the poses as evo does. Every pose of the shorter trajectory (of `est` on a tie) gets the
/// pose of the other one that is nearest in time, if the difference is at most `max_difference_s`.
/// Throws Error(kBadInput) if stamps are not finite or decrease, or if the numbers of stamps and
/// poses differ; throws Error(kNoSolution) if nothing matches.
MatchedPoses MatchByStamp(const Trajectory& est, const Trajectory& ref,
                          double max_difference_s = 0.01);

/// Finds the transform S that minimises sum |S * est_i - ref_i|^2 over the positions, in closed
/// form. `up` is the vertical of both worlds and only k4Dof uses it. Sources: Umeyama,
/// Least-squares estimation of transformation parameters between two point patterns, PAMI 1991
/// (SE(3), Sim(3)); its planar case about `up` (4 DoF). If the positions do not determine the
/// rotation (fewer than three, or on one line), it returns one of the minimisers; all have the same
/// errors. If they do not determine the scale (all positions of `est` are equal), the scale is 1.
Similarity Align(const std::vector<Pose>& est, const std::vector<Pose>& ref, Alignment alignment,
                 const Vec3& up = Vec3(0, -1, 0));

/// Absolute trajectory error: distances of positions after alignment. [m]
struct AteResult {
  ErrorStats error;
  Alignment alignment = Alignment::kNone;
  Similarity S_ref_est;  ///< the alignment
  /// false: the positions do not determine the alignment, see Align()
  bool unique = true;
  std::vector<double> errors;  ///< per pose
};

/// Computes the same as evo (`evo_ape` none, `-a` SE(3), `-as` Sim(3)), except that evo refuses
/// positions on one line. Throws Error (kBadInput) if there are no poses, the lists differ in
/// length or a value is not finite.
AteResult ComputeAte(const std::vector<Pose>& est, const std::vector<Pose>& ref,
                     Alignment alignment = Alignment::kSe3, const Vec3& up = Vec3(0, -1, 0));

/// The unit of the step between the two poses of a relative error.
enum class DeltaUnit { kFrames, kMetres };
struct RpeOptions {
  double delta = 1;  ///< > 0; a whole number of frames, or metres along the estimated path
  DeltaUnit unit = DeltaUnit::kFrames;
  /// take overlapping pairs from every pose; with kMetres the pairs within 10 % of delta, as in evo
  bool all_pairs = false;
};

/// Relative pose error: (Q_i^-1 Q_j)^-1 (P_i^-1 P_j) with the reference Q and the estimate P.
struct RpeResult {
  ErrorStats translation;   ///< [m]
  ErrorStats rotation_rad;  ///< angle of the rotation [rad]
};

/// Computes the same as evo (`evo_rpe -d delta -u f|m [--all_pairs]`, `-r trans_part` and `-r
/// angle_rad`). Without a pair all counts are 0. Throws the errors of ComputeAte, and Error(kUsage)
/// if delta is not positive or not a whole number of frames.
RpeResult ComputeRpe(const std::vector<Pose>& est, const std::vector<Pose>& ref,
                     const RpeOptions& options = {});

}  // namespace sslcd
