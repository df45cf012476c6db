// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sslcd/core/label.h"
#include "sslcd/core/layout.h"
#include "sslcd/core/pose.h"
#include "sslcd/loop/options.h"

namespace sslcd {

/// One object in the drifted local map and in the global one. Both poses are T_world_object of
/// upright objects in the same world axes.
struct DriftPair {
  Pose T_world_local, T_world_global;
  Symmetry symmetry = Symmetry::kNone;  ///< kFull also if a yaw is unknown
  /// of the difference of both positions, per horizontal axis
  double sigma_horizontal_m = 0.3;
  double sigma_vertical_m = 0.3;
  double sigma_yaw_rad = 0.1;
};

/// Makes a pair of two layout objects in their gravity-aligned axes (use it with
/// GravityFrame::FromUp(Vec3::UnitZ())). A NaN yaw counts as unknown.
DriftPair MakeDriftPair(const LayoutObject& local, const LayoutObject& global);

/// If positions determine the yaw with a larger standard deviation, the headings determine it. A
/// result with a larger one is not usable. Set by hand without a recorded search. [rad]
inline constexpr double kMaxDriftYawSigmaRad = 0.5;

/// D = T_global_local: T_world_global = D T_world_local for objects and cameras alike.
struct DriftResult {
  bool usable = false;
  std::string reason;  ///< why it is not usable
  Pose T_global_local;
  /// covariance of the right perturbation T_global_local Exp(d), d = [rho, phi]; scaled up if the
  /// residuals exceed the sigmas
  Eigen::Matrix<double, 6, 6, Eigen::DontAlign> covariance =
      Eigen::Matrix<double, 6, 6, Eigen::DontAlign>::Zero();
  int inliers = 0;   ///< number of pairs with consistent positions
  double rms_m = 0;  ///< RMS position error of the inliers
  int iterations = 0;
  bool converged = false;
};

/// Aligns the matched objects (paper IV-D, Eqs. 17 and 18, corrected). The printed residual inverts
/// the wrong factor. Here E_i = T_wo_g^-1 D T_wo_l; its translation [m] and yaw are the residual,
/// in the object frame and whitened by the pair's sigmas, with the yaw modulo the object's
/// symmetry. The residual has the translation of E instead of the rho of its logarithm, which
/// depends on a flipped heading. Position and heading have separate robust losses, so that a
/// flipped car still contributes its position.
/// 4 DoF: yaw about `gravity.up` and shift; the covariance of roll and pitch about the objects'
/// centre comes from `tilt_sigma_rad`. 6 DoF: only the positions of upright objects measure roll
/// and pitch, so `tilt_sigma_rad` is a prior on them.
///
/// Gauss-Newton from the best of several closed-form starts: the weighted Procrustes solution about
/// the vertical, and each pair's own heading difference. The result is not usable, with a reason,
/// without pairs, for input that is not finite or sigmas that are not positive, and if the yaw is
/// undetermined (one pole, or poles at the same place) or ambiguous by half a turn. Never throws.
/// O(n^2) in the number of pairs.
DriftResult SolveDrift(const std::vector<DriftPair>& pairs, const GravityFrame& gravity,
                       const DriftOptions& options);

/// T_drift that minimises Eq. 17 with the residual as printed, log(T_drift^-1 T_wo_l^-1 T_wo_g),
/// unweighted, by Gauss-Newton from the identity. Apply it as printed, T_wc' = T_drift^-1 T_wc (Eq.
/// 19). For comparison only: this T_drift is relative to the frames of the objects, which have all
/// orientations, so it removes hardly any drift. None without pairs, or if the poses are not
/// finite.
std::optional<Pose> SolveDriftAsPrinted(const std::vector<DriftPair>& pairs);

}  // namespace sslcd
