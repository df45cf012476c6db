// SPDX-License-Identifier: BSD-3-Clause
#include "closing/loop_prior.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/math.h"
#include "core/median.h"

namespace sslcd {
namespace {

constexpr double kFreedom = 8;  // of the Student-t distribution; set by hand
// Standard deviations without any path: those of the places and headings of two layouts. Set by
// hand. [m, rad]
constexpr double kLayoutMetres = 0.5, kLayoutRad = 0.02;
constexpr double kOutlier = 3;  // in standard deviations

// Log density of the standard Student-t distribution at the squared distance m2 from its centre.
double LogStudent(double m2, int dimensions) {
  return LogGamma(0.5 * (kFreedom + dimensions)) - LogGamma(0.5 * kFreedom) -
         0.5 * dimensions * std::log(kFreedom * M_PI) -
         0.5 * (kFreedom + dimensions) * std::log1p(m2 / kFreedom);
}

// Of the horizontal coordinates and the yaw.
Eigen::Matrix3d WithoutHeight(const Eigen::Matrix4d& covariance) {
  Eigen::Matrix3d level;
  level << covariance.topLeftCorner<2, 2>(), covariance.topRightCorner<2, 1>(),
      covariance.bottomLeftCorner<1, 2>(), covariance(3, 3);
  return level;
}

}  // namespace

// A perturbation [rho, phi] of the world moves the camera by rho + phi x c.
Eigen::Matrix<double, 3, 6> OdometryPrior::CameraMotion(int frame) const {
  Eigen::Matrix<double, 3, 6> motion;
  motion << Eigen::Matrix3d::Identity(),
      -lie::SO3<double>::hat(state_.frames[frame].T_world_cam.translation());
  return motion;
}

// Of the motion of the world at frame `to` against that at `from` [forward, left, up; yaw].
Eigen::Matrix4d OdometryPrior::Covariance(int from, int to) const {
  const GravityFrame& gravity = state_.gravity();
  Eigen::Matrix<double, 4, 6> to_layout;
  to_layout << gravity.Basis().transpose() * CameraMotion(to), Vec3::Zero().transpose(),
      gravity.up.transpose();
  Eigen::Matrix4d covariance = to_layout * uncertainty_.Between(from, to) * to_layout.transpose();
  covariance.diagonal().head<3>().array() += kLayoutMetres * kLayoutMetres;
  covariance(3, 3) += kLayoutRad * kLayoutRad;
  return covariance;
}

// The third diagonal element of Covariance().
double OdometryPrior::HeightVariance(int from, int to) const {
  return uncertainty_.Variance(from, to, CameraMotion(to).transpose() * state_.gravity().up) +
         kLayoutMetres * kLayoutMetres;
}

// The camera's place in the layout.
Vec3 OdometryPrior::Camera() const {
  return state_.gravity().Basis().transpose() * state_.frames[here_].T_world_cam.translation();
}

// Horizontal motion of a point under the pose, and the yaw.
Vec3 OdometryPrior::LevelError(const YawShift& pose, const Vec3& point) const {
  const Vec3 moved = Apply(pose, point) - point;
  return {moved.x(), moved.y(), WrapAngle(pose.yaw)};
}

PosePrior OdometryPrior::Of(const YawShift& pose, const LayoutFit& fit) const {
  if (fit.matches.empty()) return {};
  std::vector<double> old_m, rise;
  Vec3 centre = Vec3::Zero();
  for (const auto& [i, j] : fit.matches) {
    const LayoutObject& old = index_.objects()[j];
    old_m.push_back(passes_.passes()[passes_.PassesOf({old.id}).front()].last_m);
    rise.push_back(old.altitude - local_.objects[i].altitude);
    centre += local_.objects[i].position / static_cast<double>(fit.matches.size());
  }
  const int old = state_.frames.AtPath(Median(std::move(old_m)));
  PosePrior prior;
  prior.joins = !uncertainty_.Joined(old, here_);
  if (prior.joins) return prior;
  const Eigen::Matrix3d covariance = WithoutHeight(Covariance(old, here_));
  // Odometry places the camera, the matched objects place the pose at their centre.
  const Vec3 error = LevelError(pose, 0.5 * (Camera() + centre));
  prior.level = std::log(index_.pose_volume()) - 0.5 * std::log(covariance.determinant()) +
                LogStudent(error.dot(covariance.inverse() * error), 3);
  prior.height = OfRise(old, here_, Median(std::move(rise)));
  return prior;
}

double OdometryPrior::OfHeight(const LoopMeasurement& loop) const {
  if (!uncertainty_.Joined(loop.match, loop.query)) return 0;
  const Pose &T_world_match = state_.frames[loop.match].T_world_cam,
             &T_world_query = state_.frames[loop.query].T_world_cam;
  const Vec3 moved =
      (T_world_match * loop.row.T_match_query).translation() - T_world_query.translation();
  return OfRise(loop.match, loop.query, state_.gravity().up.dot(moved));
}

double OdometryPrior::OfRise(int from, int to, double rise_m) const {
  return LogStudent(rise_m * rise_m / HeightVariance(from, to), 1) - LogStudent(0, 1);
}

double OdometryPrior::Rank(const YawShift& pose) const {
  const Vec3 error = LevelError(pose, Camera());
  return -error.dot(WithoutHeight(Covariance(0, here_)).inverse() * error);
}

double OdometryPrior::LargestRise() const {
  constexpr int kTried = 6;  // frames along the path: the variance changes slowly
  double variance = 0;
  for (int i = 0; i < kTried; ++i)
    variance = std::max(variance, HeightVariance(here_ * i / kTried, here_));
  return kOutlier * std::sqrt(variance);
}

}  // namespace sslcd
