// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/bundle.h"

#include <ceres/ceres.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/median.h"

namespace sslcd {
namespace {

using Mat3 = Eigen::Matrix3d;
using Mat36 = Eigen::Matrix<double, 3, 6>;
using Vec3Map = Eigen::Map<Vec3>;
template <int columns>
using RowMajorMap = Eigen::Map<Eigen::Matrix<double, 3, columns, Eigen::RowMajor>>;

constexpr double kNearest = 0.1;  // [m] in front of the camera; set by hand

/// Weighted residual of one sighting (column, row, right column), with derivatives.
struct Reprojection {
  bool in_front = false;
  Vec3 residual = Vec3::Zero();
  Mat36 by_pose;  // derivative by a right perturbation of T_odom_left
  Mat3 by_point;
};

/// The weight of a sighting; zero for the right column if there is none.
Mat3 Weight(const StereoSighting& sighting) {
  Mat3 weight = sighting.weight;
  if (std::isnan(sighting.pixel.right)) {
    weight.row(2).setZero();
    weight.col(2).setZero();
  }
  return weight;
}

Reprojection Reproject(const StereoCamera& camera, const Pose& T_odom_left,
                       const StereoSighting& sighting, const Vec3& point) {
  Reprojection out;
  const Mat3 R_left_odom = T_odom_left.so3().inverse().matrix();
  const Vec3 p = R_left_odom * (point - T_odom_left.translation());
  if (!(p.z() > kNearest)) return out;
  out.in_front = true;
  const StereoPixel &pixel = sighting.pixel, seen = ProjectStereo(camera, p);
  out.residual << seen.left - pixel.left, seen.row - pixel.row,
      std::isnan(pixel.right) ? 0 : seen.right - pixel.right;
  const double iz = 1 / p.z(), fx = camera.left.fx, fy = camera.left.fy;
  Mat3 by_p;
  by_p << fx * iz, 0, -fx * p.x() * iz * iz,  //
      0, fy * iz, -fy * p.y() * iz * iz,      //
      fx * iz, 0, -fx * (p.x() - camera.baseline_m) * iz * iz;
  const Mat3 weight = Weight(sighting);
  out.residual = weight * out.residual;
  by_p = weight * by_p;
  // p(T Exp(d)) = Exp(-d) p, to first order p - rho + p x phi.
  out.by_pose << -by_p, by_p * lie::SO3<double>::hat(p);
  out.by_point = by_p * R_left_odom;
  return out;
}

/// The pose of a frame is T Exp(d). Its parameter block is d, a vector of six numbers, so it needs
/// no manifold. The other blocks are the point and the disparity at infinity.
class StereoCost final : public ceres::SizedCostFunction<3, 6, 3, 1> {
 public:
  StereoCost(const StereoCamera& camera, const StereoSighting& sighting, const Pose& T_odom_left)
      : camera_(camera), sighting_(sighting), T_odom_left_(T_odom_left) {}

  bool Evaluate(double const* const* blocks, double* residual, double** jacobians) const override {
    const Vec6 delta = Eigen::Map<const Vec6>(blocks[0]);
    const Reprojection r = Reproject(camera_, T_odom_left_ * Pose::Exp(delta), sighting_,
                                     Eigen::Map<const Vec3>(blocks[1]));
    if (!r.in_front) return false;
    const Vec3 by_infinity = -Weight(sighting_).col(2);
    Vec3Map{residual} = r.residual + (blocks[2][0] - camera_.disparity_at_infinity) * by_infinity;
    if (jacobians && jacobians[0])
      RowMajorMap<6>{jacobians[0]} = r.by_pose * Pose::RightJacobian(delta);
    if (jacobians && jacobians[1]) RowMajorMap<3>{jacobians[1]} = r.by_point;
    if (jacobians && jacobians[2]) Vec3Map{jacobians[2]} = by_infinity;
    return true;
  }

 private:
  const StereoCamera& camera_;
  const StereoSighting sighting_;
  const Pose T_odom_left_;
};

ceres::Problem::Options ProblemOptions() {
  ceres::Problem::Options options;
  options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  return options;
}

void Solve(ceres::Solver::Options options, ceres::Problem& problem) {
  constexpr double kTolerance = 1e-4;  // relative change of the cost; set by hand
  options.function_tolerance = kTolerance;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
}

bool InFront(const StereoFrame& frame, const Vec3& point) {
  return (frame.T_odom_left.inverse() * point).z() > kNearest;
}

}  // namespace

double StereoError(const StereoCamera& camera, const StereoFrame& frame,
                   const StereoSighting& sighting, const Vec3& point) {
  const Reprojection r =
      Reproject(camera, frame.T_odom_left, {sighting.point, sighting.pixel}, point);
  return r.in_front ? r.residual.cwiseAbs().maxCoeff() : std::numeric_limits<double>::infinity();
}

void RefinePose(const StereoCamera& camera, const OdometryPoints& points, double loss,
                StereoFrame& frame) {
  ceres::CauchyLoss cauchy(loss);
  ceres::Problem problem(ProblemOptions());
  Vec6 delta = Vec6::Zero();
  double at_infinity = camera.disparity_at_infinity;
  problem.AddParameterBlock(&at_infinity, 1);
  problem.SetParameterBlockConstant(&at_infinity);
  std::vector<Vec3> places;  // Ceres keeps their addresses
  places.reserve(frame.sightings.size());
  for (const StereoSighting& sighting : frame.sightings) {
    const Vec3& point = points.at(sighting.point);
    if (!InFront(frame, point)) continue;
    places.push_back(point);
    problem.AddResidualBlock(new StereoCost(camera, sighting, frame.T_odom_left), &cauchy,
                             delta.data(), places.back().data(), &at_infinity);
    problem.SetParameterBlockConstant(places.back().data());
  }
  if (places.empty()) return;
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  constexpr int kMaxIterations = 10;  // set by hand
  options.max_num_iterations = kMaxIterations;
  Solve(options, problem);
  frame.T_odom_left *= Pose::Exp(delta);
}

double RefineWindow(const StereoCamera& camera, int fixed, const std::vector<StereoFrame*>& frames,
                    double loss, OdometryPoints& points, bool calibrate) {
  std::map<int, int> times_seen;
  for (const StereoFrame* frame : frames)
    for (const StereoSighting& sighting : frame->sightings) ++times_seen[sighting.point];
  // Ceres eliminates points in the order of their addresses; one array makes this the same in each
  // run.
  std::map<int, Vec3*> place_of;
  std::vector<Vec3> places;
  places.reserve(points.size());
  for (const auto& [id, point] : points) {
    if (times_seen[id] < 2) continue;
    places.push_back(point);
    place_of[id] = &places.back();
  }

  ceres::CauchyLoss cauchy(loss);
  ceres::Problem problem(ProblemOptions());
  std::vector<Vec6> deltas(frames.size(), Vec6::Zero());
  auto* ordering = new ceres::ParameterBlockOrdering;
  double at_infinity = camera.disparity_at_infinity;
  problem.AddParameterBlock(&at_infinity, 1);
  if (!calibrate) problem.SetParameterBlockConstant(&at_infinity);
  ordering->AddElementToGroup(&at_infinity, 1);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    problem.AddParameterBlock(deltas[i].data(), 6);
    if (static_cast<int>(i) < fixed) problem.SetParameterBlockConstant(deltas[i].data());
    ordering->AddElementToGroup(deltas[i].data(), 1);
    for (const StereoSighting& sighting : frames[i]->sightings) {
      const auto place = place_of.find(sighting.point);
      if (place == place_of.end() || !InFront(*frames[i], *place->second)) continue;
      problem.AddResidualBlock(new StereoCost(camera, sighting, frames[i]->T_odom_left), &cauchy,
                               deltas[i].data(), place->second->data(), &at_infinity);
      ordering->AddElementToGroup(place->second->data(), 0);
    }
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_SCHUR;
  options.linear_solver_ordering.reset(ordering);
  // More with one more unknown. Set by hand.
  constexpr int kMaxIterations = 8, kMaxCalibrationIterations = 20;
  options.max_num_iterations = calibrate ? kMaxCalibrationIterations : kMaxIterations;
  Solve(options, problem);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    frames[i]->T_odom_left *= Pose::Exp(deltas[i]);
    frames[i]->T_odom_left.normalise();
  }
  for (const auto& [id, place] : place_of) points[id] = *place;
  return at_infinity;
}

Vec3 ResidualScale(const StereoCamera& camera, const StereoFrame& frame,
                   const OdometryPoints& points) {
  // median of the absolute value of a standard normal variable
  constexpr double kSigmasPerMedian = 1.4826;
  std::vector<double> residuals[3];
  for (const StereoSighting& sighting : frame.sightings) {
    const Reprojection r =
        Reproject(camera, frame.T_odom_left, sighting, points.at(sighting.point));
    if (!r.in_front) continue;
    const int known = std::isnan(sighting.pixel.right) ? 2 : 3;
    for (int i = 0; i < known; ++i) residuals[i].push_back(std::abs(r.residual[i]));
  }
  Vec3 scale = Vec3::Zero();
  for (int i = 0; i < 3; ++i)
    if (!residuals[i].empty()) scale[i] = kSigmasPerMedian * Median(std::move(residuals[i]));
  return scale;
}

Pose::Matrix6 StepCovariance(const StereoCamera& camera, const StereoFrame& from,
                             const StereoFrame& to, const OdometryPoints& points, double noise) {
  std::map<int, StereoSighting> seen_before;
  for (const StereoSighting& sighting : from.sightings) seen_before[sighting.point] = sighting;
  constexpr double kPrior = 1e-6;  // keeps the information regular without points; set by hand
  Eigen::Matrix<double, 6, 6> information = kPrior * Eigen::Matrix<double, 6, 6>::Identity();
  for (const StereoSighting& sighting : to.sightings) {
    const auto before = seen_before.find(sighting.point);
    if (before == seen_before.end()) continue;
    const Vec3& point = points.at(sighting.point);
    const Reprojection a = Reproject(camera, from.T_odom_left, before->second, point);
    const Reprojection b = Reproject(camera, to.T_odom_left, sighting, point);
    if (!a.in_front || !b.in_front) continue;
    // [A B; B' C] with the point last; without it remains A - B C^-1 B'.
    const Mat36 B = b.by_point.transpose() * b.by_pose;
    const Mat3 C = a.by_point.transpose() * a.by_point + b.by_point.transpose() * b.by_point;
    information += b.by_pose.transpose() * b.by_pose - B.transpose() * C.ldlt().solve(B);
  }
  return noise * noise * information.ldlt().solve(Eigen::Matrix<double, 6, 6>::Identity());
}

}  // namespace sslcd
