// SPDX-License-Identifier: BSD-3-Clause
#include "refine/improvement.h"

#include <cmath>
#include <vector>

#include <Eigen/Geometry>

#include "bundle/path_variance.h"
#include "refine/trajectory_correction.h"

namespace sslcd {
namespace {

using Points = Eigen::Matrix3Xd;  // [forward, left, up], a column each

Points Centred(const Points& points) { return points.colwise() - points.rowwise().mean(); }

// What is left of `to` - `from` after the best alignment by shift and yaw.
Points Change(const Points& from, const Points& to) {
  const Points p = Centred(from), q = Centred(to);
  const double sine = p.row(0).dot(q.row(1)) - p.row(1).dot(q.row(0));
  const double cosine = p.row(0).dot(q.row(0)) + p.row(1).dot(q.row(1));
  const Eigen::AngleAxisd turn(std::atan2(sine, cosine), Vec3::UnitZ());
  return q - turn.toRotationMatrix() * p;
}

// Horizontal position and heading of one pose with height and tilt of the other.
Pose Combine(const Pose& horizontal, const Pose& height, const GravityFrame& gravity) {
  const double turn = gravity.YawOf(horizontal.so3() * height.so3().inverse() * gravity.Upright(0));
  const Vec3 rise = gravity.up * gravity.up.dot(height.translation() - horizontal.translation());
  return Pose(lie::SO3<double>::Exp(turn * gravity.up) * height.so3(),
              horizontal.translation() + rise);
}

}  // namespace

double ProbabilityNearer(double change, double variance) {
  if (!(change > 0)) return 0.5;
  return 0.5 * std::erfc(-0.5 * change / std::sqrt(2 * variance));
}

ImprovementProbability ProbabilityOfImprovement(const MapState& state, double log_scale,
                                                const LoopEvidence& loops,
                                                const WholeMapOptions& options) {
  const FrameStore& frames = state.frames;
  const std::vector<int> keyframes =
      SelectKeyframes(frames, options.refine.keyframe_m, options.refine.keyframe_rad);
  const Eigen::Index count = static_cast<Eigen::Index>(keyframes.size());
  const Eigen::Matrix3d basis = state.gravity().Basis();
  Points odometry(3, count), optimised(3, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const FrameRecord& frame = frames[keyframes[static_cast<std::size_t>(i)]];
    odometry.col(i) = basis.transpose() * frame.T_input_cam.translation();
    optimised.col(i) = basis.transpose() * frame.T_world_cam.translation();
  }
  Points horizontal = Change(odometry, optimised), height = horizontal;
  horizontal.row(2).setZero();
  height.topRows<2>().setZero();
  const BaProblem problem = MapProblem(state, keyframes, log_scale, loops, options);
  const auto variances = PathVariances(problem, options.ba, {basis * horizontal, basis * height});
  if (!variances) return {};
  return {ProbabilityNearer(horizontal.squaredNorm(), (*variances)[0]),
          ProbabilityNearer(height.squaredNorm(), (*variances)[1])};
}

void KeepOdometry(const KeptOdometry& parts, MapState& state, const DetectionNoise& noise) {
  const std::vector<Pose> before = PosesOf(state.frames);
  for (int f = 0; f < state.frames.size(); ++f) {
    const Pose &odometry = state.frames[f].T_input_cam, &optimised = before[f];
    Pose pose = Combine(parts.horizontal ? odometry : optimised,
                        parts.height ? odometry : optimised, state.gravity());
    if (!parts.rise_m.empty())
      pose.translation() += parts.rise_m[static_cast<std::size_t>(f)] * state.gravity().up;
    state.frames.SetPose(f, pose);
  }
  MoveObjects(state, before, noise);
}

}  // namespace sslcd
