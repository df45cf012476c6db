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

// The yaw that aligns two sets of points around their centres.
double YawBetween(const Points& p, const Points& q) {
  const double sine = p.row(0).dot(q.row(1)) - p.row(1).dot(q.row(0));
  const double cosine = p.row(0).dot(q.row(0)) + p.row(1).dot(q.row(1));
  return std::atan2(sine, cosine);
}

// What is left of `to` - `from` after the best alignment by shift and yaw.
Points Change(const Points& from, const Points& to) {
  const Points p = Centred(from), q = Centred(to);
  const Eigen::AngleAxisd turn(YawBetween(p, q), Vec3::UnitZ());
  return q - turn.toRotationMatrix() * p;
}

// The best alignment of the odometry of a part with its poses `optimised`.
Pose PlaceOf(const FrameStore& frames, const std::vector<Pose>& optimised, int part,
             const GravityFrame& gravity) {
  const int first = frames.parts()[part];
  const Eigen::Index count = frames.EndOfPart(part) - first;
  const Eigen::Matrix3d to_layout = gravity.Basis().transpose();
  Points odometry(3, count), now(3, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const int f = first + static_cast<int>(i);
    odometry.col(i) = to_layout * frames[f].T_input_cam.translation();
    now.col(i) = to_layout * optimised[static_cast<std::size_t>(f)].translation();
  }
  const auto turn =
      lie::SO3<double>::Exp(Vec3(YawBetween(Centred(odometry), Centred(now)) * gravity.up));
  const Vec3 from = gravity.Basis() * odometry.rowwise().mean(),
             to = gravity.Basis() * now.rowwise().mean();
  return Pose(turn, to - turn * from);
}

// What places the odometry of each part relative to that of the first one.
std::vector<Pose> PlacesOfParts(const FrameStore& frames, const std::vector<Pose>& optimised,
                                const GravityFrame& gravity) {
  std::vector<Pose> places(frames.parts().size());
  for (std::size_t k = 1; k < places.size(); ++k)
    places[k] = PlaceOf(frames, optimised, 0, gravity).inverse() *
                PlaceOf(frames, optimised, static_cast<int>(k), gravity);
  return places;
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
  Points horizontal(3, count);
  for (Eigen::Index first = 0, next = 0; first < count; first = next) {
    const auto part_of = [&](Eigen::Index i) {
      return frames[keyframes[static_cast<std::size_t>(i)]].failures.lost;
    };
    while (next < count && part_of(next) == part_of(first)) ++next;
    horizontal.middleCols(first, next - first) =
        Change(odometry.middleCols(first, next - first), optimised.middleCols(first, next - first));
  }
  Points height = horizontal;
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
  std::vector<Pose> places = PlacesOfParts(state.frames, before, state.gravity());
  if (!parts.rise_m.empty())  // has them, too
    for (Pose& place : places)
      place.translation() -= state.gravity().up * state.gravity().up.dot(place.translation());
  for (int f = 0; f < state.frames.size(); ++f) {
    const FrameRecord& frame = state.frames[f];
    const Pose& optimised = before[f];
    const Pose odometry =
        frame.failures.lost == 0
            ? frame.T_input_cam
            : places[static_cast<std::size_t>(frame.failures.lost)] * frame.T_input_cam;
    Pose pose = Combine(parts.horizontal ? odometry : optimised,
                        parts.height ? odometry : optimised, state.gravity());
    if (!parts.rise_m.empty())
      pose.translation() += parts.rise_m[static_cast<std::size_t>(f)] * state.gravity().up;
    state.frames.SetPose(f, pose);
  }
  MoveObjects(state, before, noise);
}

}  // namespace sslcd
