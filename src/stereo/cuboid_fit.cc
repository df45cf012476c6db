// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/cuboid_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace sslcd {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// What is solved for. x, z: centre on the ground, right of and before the camera; base: ground over the plane.
enum Parameter { kX, kZ, kYaw, kLength, kWidth, kHeight, kBase, kBias, kParameters };
using Parameters = Eigen::Matrix<double, kParameters, 1>;
using Normal = Eigen::Matrix<double, kParameters, kParameters>;

/// Corners of the image of a body of sheet metal, as shares of length, width, height from the middle of the bottom, for
/// one of four symmetric quarters: tyre, bumper, side, roof. A cuboid's own corners stand out by decimetres.
std::array<Vec3, 6> Quarter(const ClassPrior& prior) {
  const bool wheels = prior.overhang > 0;
  const double sill = wheels ? 0.14 : 0;
  return {Vec3(0.5 - prior.overhang, 0.48, 0),
          Vec3(0.5, 0.38, sill),
          Vec3(0.5, 0.38, 0.55),
          Vec3(0.42, 0.5, sill),
          Vec3(0.42, 0.5, 0.6),
          Vec3(0.5 * prior.roof, 0.38, 1)};
}

class Problem {
 public:
  Problem(const FitInput& input, const StereoCamera& camera, const GroundPlane& ground, const LiftOptions& options)
      : input_(input),
        camera_(camera.left),
        ground_(ground),
        options_(options),
        quarter_(Quarter(input.prior)),
        bf_(camera.baseline_m * camera.left.fx) {
    const Vec3 forward = (Vec3::UnitZ() - ground.up.z() * ground.up).normalized();
    axes_.col(0) = forward.cross(ground.up);  // right = up x back
    axes_.col(1) = ground.up;
    axes_.col(2) = forward;
    for (const ScanPoint& point : input.scan) {
      const Vec3 ray((point.u - camera_.cx) / camera_.fx, (point.v - camera_.cy) / camera_.fy, 1);
      const Vec3 level = axes_.transpose() * ray;
      rays_.emplace_back(level.x(), level.z());
    }
  }

  int residuals() const { return static_cast<int>(rays_.size()) + 4 + 5; }

  /// Whitened; robust ones are weighted by `Weight` later.
  void Residuals(const Parameters& p, Eigen::VectorXd& out) const {
    int row = 0;
    for (std::size_t i = 0; i < rays_.size(); ++i) {
      const double predicted = bf_ / Depth(p, rays_[i]) + p[kBias];
      out[row++] = (input_.scan[i].disparity - predicted) / options_.disparity_sigma_px;
    }
    const Box2d seen = Silhouette(p);
    const double shape_px = options_.shape_sigma_m / std::max(p[kZ], 0.5);
    const double sigma_x = std::hypot(options_.box_sigma_px, camera_.fx * shape_px);
    const double sigma_y = std::hypot(options_.box_sigma_px, camera_.fy * shape_px);
    const auto side = [](double beyond, bool open, double sigma) {
      return open ? std::min(beyond, 0.) / sigma : beyond / sigma;
    };
    out[row++] = side(input_.box.left - seen.left, input_.sides.left_open, sigma_x);
    out[row++] = side(seen.right - input_.box.right, input_.sides.right_open, sigma_x);
    out[row++] = side(input_.box.top - seen.top, input_.sides.top_open, sigma_y);
    out[row++] = side(seen.bottom - input_.box.bottom, input_.sides.bottom_open, sigma_y);
    const ClassPrior& prior = input_.prior;
    out[row++] = (p[kLength] - prior.length_m) / prior.length_sigma_m;
    out[row++] = (p[kWidth] - prior.width_m) / prior.width_sigma_m;
    out[row++] = (p[kHeight] - prior.height_m) / prior.height_sigma_m;
    out[row++] = p[kBase] / std::hypot(options_.ground_sigma_m, options_.ground_sigma_rad * p[kZ]);
    out[row++] = p[kBias] / options_.disparity_bias_px;
  }

  /// Cauchy's for the scan, whose outliers are glass, wheel arches and what stands in front.
  double Weight(int row, double residual) const {
    return row < static_cast<int>(rays_.size()) ? 1 / (1 + residual * residual / (kCauchy * kCauchy)) : 1;
  }
  double Cost(const Eigen::VectorXd& residuals) const {
    const int scan = static_cast<int>(rays_.size());
    double cost = 0;
    for (int row = 0; row < residuals.size(); ++row) {
      const double square = residuals[row] * residuals[row];
      cost += row < scan ? 0.5 * kCauchy * kCauchy * std::log1p(square / (kCauchy * kCauchy)) : 0.5 * square;
    }
    return cost;
  }

  /// With the middle of the contour on the near side of the object.
  Parameters Start(double yaw) const {
    std::vector<double> depths;
    for (const ScanPoint& point : input_.scan) depths.push_back(bf_ / point.disparity);
    std::nth_element(depths.begin(), depths.begin() + depths.size() / 2, depths.end());
    const double depth = depths[depths.size() / 2];
    const Vec2 ray = rays_[rays_.size() / 2];
    const ClassPrior& prior = input_.prior;
    const double along = std::abs(std::cos(yaw) * ray.x() + std::sin(yaw) * ray.y()) / ray.norm();
    const double half = 0.5 * (prior.length_m * along + prior.width_m * std::sqrt(std::max(0., 1 - along * along)));
    const Vec2 centre = ray * depth + ray.normalized() * 0.7 * half;
    Parameters p;
    p << centre.x(), centre.y(), yaw, prior.length_m, prior.width_m, prior.height_m, 0, 0;
    return p;
  }

  const Eigen::Matrix3d& axes() const { return axes_; }
  Vec3 CentreInCamera(const Parameters& p) const {
    return axes_ * Vec3(p[kX], p[kBase] + 0.5 * p[kHeight] - ground_.height_m, p[kZ]);
  }
  double BoxDistance(const Parameters& p) const {
    const Box2d seen = Silhouette(p);
    const auto side = [](double beyond, bool open) { return std::abs(open ? std::min(beyond, 0.) : beyond); };
    return std::max({side(input_.box.left - seen.left, input_.sides.left_open),
                     side(seen.right - input_.box.right, input_.sides.right_open),
                     side(input_.box.top - seen.top, input_.sides.top_open),
                     side(seen.bottom - input_.box.bottom, input_.sides.bottom_open)});
  }

 private:
  static constexpr double kCauchy = 2;

  /// Where the ray (right, forward; 1 along the optical axis) meets the footprint, else the corner nearest to it.
  double Depth(const Parameters& p, const Vec2& ray) const {
    const double c = std::cos(p[kYaw]), s = std::sin(p[kYaw]);
    const Vec2 direction(c * ray.x() + s * ray.y(), -s * ray.x() + c * ray.y());
    const Vec2 origin(-c * p[kX] - s * p[kZ], s * p[kX] - c * p[kZ]);
    const Vec2 half(0.5 * p[kLength], 0.5 * p[kWidth]);
    double enter = -std::numeric_limits<double>::infinity(), leave = -enter;
    for (int axis = 0; axis < 2; ++axis) {
      const double speed = std::abs(direction[axis]) > 1e-9 ? direction[axis] : 1e-9;
      const double a = (-half[axis] - origin[axis]) / speed, b = (half[axis] - origin[axis]) / speed;
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    }
    if (enter <= leave) return std::max(enter, 0.1);
    double closest = std::numeric_limits<double>::infinity(), depth = 0.1;
    for (int corner = 0; corner < 4; ++corner) {
      const Vec2 to(corner & 1 ? half.x() - origin.x() : -half.x() - origin.x(),
                    corner & 2 ? half.y() - origin.y() : -half.y() - origin.y());
      const double off = std::abs(direction.x() * to.y() - direction.y() * to.x());
      if (off >= closest) continue;
      closest = off;
      depth = to.dot(direction) / direction.squaredNorm();
    }
    return std::max(depth, 0.1);
  }

  Box2d Silhouette(const Parameters& p) const {
    constexpr double kInf = std::numeric_limits<double>::infinity();
    Box2d seen{kInf, kInf, -kInf, -kInf};
    const double c = std::cos(p[kYaw]), s = std::sin(p[kYaw]);
    for (const Vec3& part : quarter_) {
      for (int sign = 0; sign < 4; ++sign) {
        const double along = (sign & 1 ? 1 : -1) * part.x() * p[kLength];
        const double across = (sign & 2 ? 1 : -1) * part.y() * p[kWidth];
        const Vec3 level(p[kX] + c * along - s * across, p[kBase] + part.z() * p[kHeight] - ground_.height_m,
                         p[kZ] + s * along + c * across);
        const Vec3 point = axes_ * level;
        const double z = std::max(point.z(), 0.3);
        const double u = camera_.fx * point.x() / z + camera_.cx, v = camera_.fy * point.y() / z + camera_.cy;
        seen = {std::min(seen.left, u), std::min(seen.top, v), std::max(seen.right, u), std::max(seen.bottom, v)};
      }
    }
    return seen;
  }

  const FitInput& input_;
  const Camera& camera_;
  const GroundPlane& ground_;
  const LiftOptions& options_;
  std::array<Vec3, 6> quarter_;
  double bf_;
  Eigen::Matrix3d axes_;  // columns right, up, forward in the camera
  std::vector<Vec2> rays_;
};

struct Solution {
  Parameters p;
  Normal information;
  double cost;
};

Normal NormalEquations(const Problem& problem, const Parameters& p, const Eigen::VectorXd& residuals,
                       Parameters& gradient) {
  Eigen::Matrix<double, Eigen::Dynamic, kParameters> jacobian(residuals.size(), int{kParameters});
  Eigen::VectorXd moved(residuals.size());
  for (int i = 0; i < kParameters; ++i) {
    constexpr double kStep = 1e-4;
    Parameters ahead = p;
    ahead[i] += kStep;
    problem.Residuals(ahead, moved);
    jacobian.col(i) = (moved - residuals) / kStep;
  }
  Eigen::VectorXd weights(residuals.size());
  for (int row = 0; row < residuals.size(); ++row) weights[row] = problem.Weight(row, residuals[row]);
  gradient = jacobian.transpose() * weights.cwiseProduct(residuals);
  return jacobian.transpose() * weights.asDiagonal() * jacobian;
}

/// Levenberg-Marquardt.
Solution Solve(const Problem& problem, Parameters p, int iterations) {
  Eigen::VectorXd residuals(problem.residuals()), tried(problem.residuals());
  problem.Residuals(p, residuals);
  Solution solution{p, Normal::Identity(), problem.Cost(residuals)};
  double damping = 1e-2;
  Parameters gradient;
  solution.information = NormalEquations(problem, p, residuals, gradient);
  for (int i = 0; i < iterations; ++i) {
    Normal damped = solution.information;
    damped.diagonal() *= 1 + damping;
    const Parameters next = solution.p - damped.ldlt().solve(gradient);
    problem.Residuals(next, tried);
    const double cost = next.allFinite() ? problem.Cost(tried) : std::numeric_limits<double>::infinity();
    if (!(cost < solution.cost)) {
      damping *= 8;
      if (damping > 1e6) break;
      continue;
    }
    const double gain = solution.cost - cost;
    solution.p = next;
    solution.cost = cost;
    residuals = tried;
    damping = std::max(damping / 5, 1e-6);
    solution.information = NormalEquations(problem, next, residuals, gradient);
    if (gain < 1e-4) break;
  }
  return solution;
}

}  // namespace

std::optional<CuboidFit> FitCuboid(const FitInput& input, const StereoCamera& camera, const GroundPlane& ground,
                                   const LiftOptions& options) {
  if (input.scan.empty()) return std::nullopt;
  const Problem problem(input, camera, ground, options);
  constexpr int kStarts = 12;
  std::vector<Solution> solutions;
  for (int i = 0; i < kStarts; ++i) solutions.push_back(Solve(problem, problem.Start(i * kPi / kStarts), 12));
  std::sort(solutions.begin(), solutions.end(), [](const Solution& a, const Solution& b) { return a.cost < b.cost; });
  if (!std::isfinite(solutions.front().cost)) return std::nullopt;
  const Solution best = Solve(problem, solutions.front().p, 20);
  const Parameters& p = best.p;
  if (!(p[kLength] > 0.1 && p[kWidth] > 0.1 && p[kHeight] > 0.1)) return std::nullopt;

  const Normal covariance = best.information.ldlt().solve(Normal::Identity());
  if (!covariance.allFinite()) return std::nullopt;
  CuboidFit fit;
  const Eigen::Matrix3d& axes = problem.axes();
  Eigen::Matrix3d object;  // columns: length, left, up
  object.col(0) = axes.col(0) * std::cos(p[kYaw]) + axes.col(2) * std::sin(p[kYaw]);
  object.col(2) = axes.col(1);
  object.col(1) = object.col(2).cross(object.col(0));
  fit.T_cam_object = Pose(lie::SO3<double>::FromMatrix(object), problem.CentreInCamera(p));
  fit.dims = {p[kLength], p[kWidth], p[kHeight]};
  Eigen::Matrix<double, 3, kParameters> centre = Eigen::Matrix<double, 3, kParameters>::Zero();
  centre.col(kX) = axes.col(0);
  centre.col(kZ) = axes.col(2);
  centre.col(kBase) = axes.col(1);
  centre.col(kHeight) = 0.5 * axes.col(1);
  fit.covariance = centre * covariance * centre.transpose();
  fit.dims_sigma = covariance.diagonal().segment<3>(kLength).cwiseMax(0).cwiseSqrt();
  // Other headings that explain what is seen, each with its likelihood.
  double weights = 0, spread = 0;
  for (const Solution& solution : solutions) {
    const double weight = std::exp(best.cost - solution.cost);
    const double turn = WrapAngle(solution.p[kYaw] - p[kYaw], kPi);
    weights += weight;
    spread += weight * turn * turn;
  }
  fit.yaw_sigma = std::sqrt(std::max(covariance(kYaw, kYaw), 0.) + spread / weights);
  fit.cost = best.cost;
  fit.worst_px = problem.BoxDistance(p);
  Eigen::VectorXd residuals(problem.residuals());
  problem.Residuals(p, residuals);
  std::vector<double> scan(input.scan.size());
  for (std::size_t i = 0; i < scan.size(); ++i) scan[i] = std::abs(residuals[i]) * options.disparity_sigma_px;
  std::nth_element(scan.begin(), scan.begin() + scan.size() / 2, scan.end());
  fit.scan_px = scan[scan.size() / 2];
  return fit;
}

}  // namespace sslcd
