// SPDX-License-Identifier: BSD-3-Clause
#include "lifting/cuboid_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/median.h"

namespace sslcd {
namespace {

// Standard deviations of the measurements and the model. With these, errors are 0.6 to 0.95 of the
// sigmas of the fit (rendered HALV-sim, case 1; docs/notes, "Cuboids from stereo images").
constexpr double kDisparitySigma = 0.3;  // [px] of one column of pixels on the object
constexpr double kDisparityBias = 0.05;  // [px] common to all columns of an object
constexpr double kShapeSigma = 0.06;     // [m] shape of the body, added to the sides of its box
constexpr double kGroundSigma = 0.04;    // [m] height of the ground under an object over the plane
constexpr double kSlopeSigma = 0.003;    // [rad] slope of the plane
constexpr double kCauchy = 2;  // [sigmas] a scan point with this error has half the weight
// Number of initial headings over half a turn, and of steps from each. Set by hand.
constexpr int kStarts = 12, kIterations = 15;
// Initial offset of the contour's middle from the centre, share of half the size along the ray. Set
// by hand.
constexpr double kNearSide = 0.7;
constexpr double kLeastSize = 0.1;   // [m] sanity bound
constexpr double kNearest = 0.1;     // [m] smallest depth of a point on a ray
constexpr double kLeastDepth = 0.3;  // [m] smallest depth of a corner
constexpr double kLeastRange = 0.5;  // [m] smallest range of the centre for its extent in the image
constexpr double kParallel = 1e-9;   // a ray's share across a side, at least

/// The unknowns. x, z: centre on the ground, right and ahead of the camera; base: height of the
/// ground over the plane.
enum Parameter { kX, kZ, kYaw, kLength, kWidth, kHeight, kBase, kBias, kParameters };
using Parameters = Eigen::Matrix<double, kParameters, 1>;
using Normal = Eigen::Matrix<double, kParameters, kParameters>;

/// Outline points of a car body for one of four symmetric quarters: tyre, bumper, side, roof. They
/// are shares of length, width and height from the middle of the bottom. The corners of a cuboid
/// would lie decimetres outside of the body. Set by hand.
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
  Problem(const FitInput& input, const StereoCamera& camera, const GroundFrame& ground)
      : input_(input),
        camera_(camera.left),
        ground_(ground),
        quarter_(Quarter(input.prior)),
        bf_(camera.baseline_m * camera.left.fx) {
    for (const ScanPoint& point : input.scan) {
      const Vec3 ray((point.u - camera_.cx) / camera_.fx, (point.v - camera_.cy) / camera_.fy, 1);
      const Vec3 level = ground_.axes.transpose() * ray;
      rays_.emplace_back(level.x(), level.z());
    }
  }

  int residuals() const { return static_cast<int>(rays_.size()) + 4 + 5; }

  /// Whitened residuals. `Weight` weights the robust ones later.
  void Residuals(const Parameters& p, Eigen::VectorXd& out) const {
    int row = 0;
    for (std::size_t i = 0; i < rays_.size(); ++i) {
      const double predicted = bf_ / Depth(p, rays_[i]) + p[kBias];
      out[row++] = (input_.scan[i].disparity - predicted) / kDisparitySigma;
    }
    const Box2d seen = Silhouette(p);
    const double shape_px = kShapeSigma / std::max(p[kZ], kLeastRange);
    const auto side = [](double beyond, bool open, double sigma, double shape) {
      return (open ? std::min(beyond, 0.) : beyond) / std::hypot(sigma, shape);
    };
    const double shape_x = camera_.fx * shape_px, shape_y = camera_.fy * shape_px;
    const Box2d &box = input_.box, &sigmas = input_.sigmas;
    out[row++] = side(box.left - seen.left, input_.sides.left_open, sigmas.left, shape_x);
    out[row++] = side(seen.right - box.right, input_.sides.right_open, sigmas.right, shape_x);
    out[row++] = side(box.top - seen.top, input_.sides.top_open, sigmas.top, shape_y);
    out[row++] = side(seen.bottom - box.bottom, input_.sides.bottom_open, sigmas.bottom, shape_y);
    const ClassPrior& prior = input_.prior;
    out[row++] = (p[kLength] - prior.length_m) / prior.length_sigma_m;
    out[row++] = (p[kWidth] - prior.width_m) / prior.width_sigma_m;
    out[row++] = (p[kHeight] - prior.height_m) / prior.height_sigma_m;
    out[row++] = p[kBase] / std::hypot(kGroundSigma, kSlopeSigma * p[kZ]);
    out[row++] = p[kBias] / kDisparityBias;
  }

  /// Cauchy's weight for the scan, whose outliers are glass, wheel arches and occluders.
  double Weight(int row, double residual) const {
    return row < static_cast<int>(rays_.size())
               ? 1 / (1 + residual * residual / (kCauchy * kCauchy))
               : 1;
  }
  double Cost(const Eigen::VectorXd& residuals) const {
    const int scan = static_cast<int>(rays_.size());
    double cost = 0;
    for (int row = 0; row < residuals.size(); ++row) {
      const double square = residuals[row] * residuals[row];
      cost += row < scan ? 0.5 * kCauchy * kCauchy * std::log1p(square / (kCauchy * kCauchy))
                         : 0.5 * square;
    }
    return cost;
  }

  /// Start with the middle of the contour on the near side of the object.
  Parameters Start(double yaw) const {
    std::vector<double> depths;
    for (const ScanPoint& point : input_.scan) depths.push_back(bf_ / point.disparity);
    const double depth = Median(std::move(depths));
    const Vec2 ray = rays_[rays_.size() / 2];
    const ClassPrior& prior = input_.prior;
    const double along = std::abs(std::cos(yaw) * ray.x() + std::sin(yaw) * ray.y()) / ray.norm();
    const double half =
        0.5 * (prior.length_m * along + prior.width_m * std::sqrt(std::max(0., 1 - along * along)));
    const Vec2 centre = ray * depth + ray.normalized() * kNearSide * half;
    Parameters p;
    p << centre.x(), centre.y(), yaw, prior.length_m, prior.width_m, prior.height_m, 0, 0;
    return p;
  }

  /// Penalty of overlap with occupied ground.
  double Crowding(const Parameters& p) const {
    constexpr int kAlong = 9, kAcross = 5;  // sample points of the footprint
    // For a footprint on completely occupied ground. Set by hand.
    constexpr double kCost = 20;
    int taken = 0;
    const double c = std::cos(p[kYaw]), s = std::sin(p[kYaw]);
    for (int i = 0; i < kAlong; ++i) {
      for (int j = 0; j < kAcross; ++j) {
        const double along = ((i + 0.5) / kAlong - 0.5) * p[kLength],
                     across = ((j + 0.5) / kAcross - 0.5) * p[kWidth];
        const double x = p[kX] + c * along - s * across, z = p[kZ] + s * along + c * across;
        taken += std::any_of(input_.taken.begin(), input_.taken.end(),
                             [&](const Footprint& other) { return other.Contains(x, z, 0); });
      }
    }
    return kCost * taken / (kAlong * kAcross);
  }

 private:
  /// The point where the ray (right, forward; 1 along the optical axis) hits the footprint,
  /// otherwise the corner nearest to the ray.
  double Depth(const Parameters& p, const Vec2& ray) const {
    const double c = std::cos(p[kYaw]), s = std::sin(p[kYaw]);
    const Vec2 direction(c * ray.x() + s * ray.y(), -s * ray.x() + c * ray.y());
    const Vec2 origin(-c * p[kX] - s * p[kZ], s * p[kX] - c * p[kZ]);
    const Vec2 half(0.5 * p[kLength], 0.5 * p[kWidth]);
    double enter = -std::numeric_limits<double>::infinity(), leave = -enter;
    for (int axis = 0; axis < 2; ++axis) {
      const double speed = std::abs(direction[axis]) > kParallel ? direction[axis] : kParallel;
      const double a = (-half[axis] - origin[axis]) / speed,
                   b = (half[axis] - origin[axis]) / speed;
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    }
    if (enter <= leave) return std::max(enter, kNearest);
    double closest = std::numeric_limits<double>::infinity(), depth = kNearest;
    for (int corner = 0; corner < 4; ++corner) {
      const Vec2 to(corner & 1 ? half.x() - origin.x() : -half.x() - origin.x(),
                    corner & 2 ? half.y() - origin.y() : -half.y() - origin.y());
      const double off = std::abs(direction.x() * to.y() - direction.y() * to.x());
      if (off >= closest) continue;
      closest = off;
      depth = to.dot(direction) / direction.squaredNorm();
    }
    return std::max(depth, kNearest);
  }

  Box2d Silhouette(const Parameters& p) const {
    constexpr double kInf = std::numeric_limits<double>::infinity();
    Box2d seen{kInf, kInf, -kInf, -kInf};
    const double c = std::cos(p[kYaw]), s = std::sin(p[kYaw]);
    for (const Vec3& part : quarter_) {
      for (int sign = 0; sign < 4; ++sign) {
        const double along = (sign & 1 ? 1 : -1) * part.x() * p[kLength];
        const double across = (sign & 2 ? 1 : -1) * part.y() * p[kWidth];
        const Vec3 point =
            ground_.ToCamera({p[kX] + c * along - s * across, p[kBase] + part.z() * p[kHeight],
                              p[kZ] + s * along + c * across});
        const double z = std::max(point.z(), kLeastDepth);
        const double u = camera_.fx * point.x() / z + camera_.cx,
                     v = camera_.fy * point.y() / z + camera_.cy;
        seen = {std::min(seen.left, u), std::min(seen.top, v), std::max(seen.right, u),
                std::max(seen.bottom, v)};
      }
    }
    return seen;
  }

  const FitInput& input_;
  const Camera& camera_;
  const GroundFrame& ground_;
  std::array<Vec3, 6> quarter_;
  double bf_;
  std::vector<Vec2> rays_;
};

struct Solution {
  Parameters p;
  Normal information;
  double cost;
};

Normal NormalEquations(const Problem& problem, const Parameters& p,
                       const Eigen::VectorXd& residuals, Parameters& gradient) {
  Eigen::Matrix<double, Eigen::Dynamic, kParameters> jacobian(residuals.size(), int{kParameters});
  Eigen::VectorXd moved(residuals.size());
  for (int i = 0; i < kParameters; ++i) {
    constexpr double kStep = 1e-4;  // of the difference quotient [m, rad, px]
    Parameters ahead = p;
    ahead[i] += kStep;
    problem.Residuals(ahead, moved);
    jacobian.col(i) = (moved - residuals) / kStep;
  }
  Eigen::VectorXd weights(residuals.size());
  for (int row = 0; row < residuals.size(); ++row)
    weights[row] = problem.Weight(row, residuals[row]);
  gradient = jacobian.transpose() * weights.cwiseProduct(residuals);
  return jacobian.transpose() * weights.asDiagonal() * jacobian;
}

/// Levenberg-Marquardt.
Solution Solve(const Problem& problem, Parameters p) {
  // Damping: initial, smallest and largest value; factor after a failed step, divisor after a
  // successful one.
  constexpr double kDamping = 1e-2, kLeastDamping = 1e-6, kMostDamping = 1e6;
  constexpr double kMoreDamping = 8, kLessDamping = 5;
  constexpr double kLeastGain =
      1e-4;  // share of the cost; a smaller gain is irrelevant; set by hand
  Eigen::VectorXd residuals(problem.residuals()), tried(problem.residuals());
  problem.Residuals(p, residuals);
  Solution solution{p, Normal::Identity(), problem.Cost(residuals)};
  double damping = kDamping;
  Parameters gradient;
  solution.information = NormalEquations(problem, p, residuals, gradient);
  for (int i = 0; i < kIterations; ++i) {
    Normal damped = solution.information;
    damped.diagonal() *= 1 + damping;
    const Parameters next = solution.p - damped.ldlt().solve(gradient);
    problem.Residuals(next, tried);
    const double cost =
        next.allFinite() ? problem.Cost(tried) : std::numeric_limits<double>::infinity();
    if (!(cost < solution.cost)) {
      damping *= kMoreDamping;
      if (damping > kMostDamping) break;
      continue;
    }
    const double gain = solution.cost - cost;
    solution.p = next;
    solution.cost = cost;
    residuals = tried;
    damping = std::max(damping / kLessDamping, kLeastDamping);
    solution.information = NormalEquations(problem, next, residuals, gradient);
    if (gain < kLeastGain) break;
  }
  return solution;
}

Pose PoseOf(const Parameters& p, const GroundFrame& ground) {
  Eigen::Matrix3d object;  // columns: along the length, to the left, up
  object.col(0) = ground.axes.col(0) * std::cos(p[kYaw]) + ground.axes.col(2) * std::sin(p[kYaw]);
  object.col(2) = ground.axes.col(1);
  object.col(1) = object.col(2).cross(object.col(0));
  return {lie::SO3<double>::FromMatrix(object),
          ground.ToCamera({p[kX], p[kBase] + 0.5 * p[kHeight], p[kZ]})};
}

/// The covariance of the best fit plus the scatter of all fits of similar cost, weighted by
/// likelihood.
Normal Covariance(const std::vector<Solution>& solutions) {
  const Solution& best = solutions.front();
  Normal scatter = Normal::Zero();
  double weights = 0;
  for (const Solution& solution : solutions) {
    const double weight = std::exp(best.cost - solution.cost);
    Parameters off = solution.p - best.p;
    off[kYaw] = WrapAngle(off[kYaw], M_PI);
    scatter += weight * off * off.transpose();
    weights += weight;
  }
  return best.information.ldlt().solve(Normal::Identity()) + scatter / weights;
}

}  // namespace

std::optional<CuboidFit> FitCuboid(const FitInput& input, const StereoCamera& camera,
                                   const GroundFrame& ground) {
  if (input.scan.empty()) return std::nullopt;
  const Problem problem(input, camera, ground);
  std::vector<Solution> solutions;
  for (int i = 0; i < kStarts; ++i) {
    Solution solution = Solve(problem, problem.Start(i * M_PI / kStarts));
    solution.cost += problem.Crowding(solution.p);
    const bool sound =
        solution.p.segment<3>(kLength).minCoeff() > kLeastSize && std::isfinite(solution.cost);
    if (sound) solutions.push_back(solution);
  }
  if (solutions.empty()) return std::nullopt;
  std::stable_sort(solutions.begin(), solutions.end(),
                   [](const auto& a, const auto& b) { return a.cost < b.cost; });
  const Parameters& p = solutions.front().p;
  const Normal covariance = Covariance(solutions);
  if (!covariance.allFinite()) return std::nullopt;

  CuboidFit fit;
  fit.scan = input.scan;
  fit.T_cam_object = PoseOf(p, ground);
  fit.dims = p.segment<3>(kLength);
  fit.footprint = {p[kX], p[kZ], p[kYaw], p[kLength], p[kWidth]};
  Eigen::Matrix<double, 3, kParameters> centre = Eigen::Matrix<double, 3, kParameters>::Zero();
  centre.col(kX) = ground.axes.col(0);
  centre.col(kZ) = ground.axes.col(2);
  centre.col(kBase) = ground.axes.col(1);
  centre.col(kHeight) = 0.5 * ground.axes.col(1);
  fit.covariance = centre * covariance * centre.transpose();
  fit.dims_sigma = covariance.diagonal().segment<3>(kLength).cwiseMax(0).cwiseSqrt();
  fit.yaw_sigma = std::sqrt(std::max(covariance(kYaw, kYaw), 0.));
  fit.cost = solutions.front().cost;
  Eigen::VectorXd residuals(problem.residuals());
  problem.Residuals(p, residuals);
  const auto scan = static_cast<Eigen::Index>(input.scan.size());
  fit.box_error = residuals.segment<4>(scan).cwiseAbs().maxCoeff();
  const Eigen::VectorXd distances = residuals.head(scan).cwiseAbs();
  fit.scan_error = Median(std::vector<double>(distances.begin(), distances.end()));
  return fit;
}

}  // namespace sslcd
