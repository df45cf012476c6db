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

/// One object, twice: in the local map, which has drifted, and in the global one. Both poses are
/// T_world_object of upright objects, in the same world axes.
struct DriftPair {
  Pose T_world_local, T_world_global;
  Symmetry symmetry = Symmetry::kNone;  ///< kFull also where a yaw is unknown
  double sigma_horizontal_m = 0.3;      ///< of the two positions' difference, each horizontal axis
  double sigma_vertical_m = 0.3;
  double sigma_yaw_rad = 0.1;
};

/// The pair of two layout objects, in their gravity-aligned axes (use
/// GravityFrame::FromUp(Vec3::UnitZ()) with it). A yaw that is NaN counts as none.
DriftPair MakeDriftPair(const LayoutObject& local, const LayoutObject& global);

/// Where positions fix the yaw worse than this, it comes from the headings; a result whose yaw is
/// less certain is none. Set by hand; no search over it is recorded. [rad]
inline constexpr double kMaxDriftYawSigmaRad = 0.5;

/// D = T_global_local: T_world_global = D T_world_local for objects and cameras alike.
struct DriftResult {
  bool usable = false;
  std::string reason;  ///< why it is not usable, one line
  Pose T_global_local;
  /// Of the right perturbation T_global_local Exp(d), d = [rho, phi]. Larger than the sigmas alone
  /// would give where the residuals are.
  Eigen::Matrix<double, 6, 6, Eigen::DontAlign> covariance =
      Eigen::Matrix<double, 6, 6, Eigen::DontAlign>::Zero();
  int inliers = 0;   ///< pairs whose positions agree
  double rms_m = 0;  ///< of the inliers' position errors
  int iterations = 0;
  bool converged = false;
};

/// Aligns the matched objects (paper IV-D, Eqs. 17 and 18, repaired). The printed residual has the
/// inverse on the wrong factor; here E_i = T_wo_g^-1 D T_wo_l, whose translation [m] and yaw are
/// the residual, in the object frame and whitened by the pair's sigmas; the yaw is taken modulo the
/// object's symmetry. The translation of E rather than the rho of its logarithm, which a flipped
/// heading would bend; and position and heading have a robust loss each, so that a flipped car
/// still says where it is.
///
/// 4 DoF: yaw about `gravity.up` and shift; the covariance has `tilt_sigma_rad` about the objects'
/// centre for the other two. 6 DoF: upright objects say nothing of roll and pitch but by their
/// positions, so `tilt_sigma_rad` is a prior on them.
///
/// Gauss-Newton from the best of several closed-form starts: the weighted Procrustes solution about
/// the vertical, and each pair's own heading difference. Not usable, with the reason: no pair;
/// input that is not finite or sigmas that are not positive; a yaw that nothing fixes (one pole, or
/// poles on one spot), or only up to half a turn. Never throws. O(n^2) in the number of pairs.
DriftResult SolveDrift(const std::vector<DriftPair>& pairs, const GravityFrame& gravity,
                       const DriftOptions& options);

/// T_drift that minimises Eq. 17 with the residual as printed, log(T_drift^-1 T_wo_l^-1 T_wo_g),
/// unweighted, by Gauss-Newton from the identity; to be applied as printed, T_wc' = T_drift^-1 T_wc
/// (Eq. 19). For comparison only: this T_drift lives in the frames of the objects, which point in
/// all directions, and removes next to nothing. None if there is no pair, or the poses are not
/// finite.
std::optional<Pose> SolveDriftAsPrinted(const std::vector<DriftPair>& pairs);

}  // namespace sslcd
