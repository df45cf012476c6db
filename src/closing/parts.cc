// SPDX-License-Identifier: BSD-3-Clause
#include "closing/parts.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "refine/trajectory_correction.h"

namespace sslcd {
namespace {

// From the map to a part beside it: farther than most drives go, and near enough for coordinates in
// single precision. Set by hand. [m]
constexpr double kBeside = 5000;

int PartOf(const FrameStore& frames, int frame) { return frames[frame].failures.lost; }

// The motion by yaw and shift that moves a camera to another pose.
Pose LevelMotion(const Pose& T_from, const Pose& T_to, const GravityFrame& gravity) {
  const double yaw = gravity.YawOf(T_to.so3() * T_from.so3().inverse() * gravity.Upright(0));
  const auto turn = lie::SO3<double>::Exp(Vec3(yaw * gravity.up));
  return Pose(turn, T_to.translation() - turn * T_from.translation());
}

}  // namespace

std::vector<int> JoinParts(const FrameStore& frames, const std::vector<LoopEdge>& loops) {
  std::vector<int> joined(frames.parts().size());
  std::iota(joined.begin(), joined.end(), 0);
  for (const LoopEdge& loop : loops) {
    const int a = joined[PartOf(frames, loop.match)], b = joined[PartOf(frames, loop.query)];
    std::replace(joined.begin(), joined.end(), std::max(a, b), std::min(a, b));
  }
  return joined;
}

void PlaceParts(MapState& state, std::vector<LoopEdge> known, const std::vector<LoopEdge>& found,
                const DetectionNoise& noise) {
  FrameStore& frames = state.frames;
  for (const LoopEdge& loop : found) {
    const std::vector<int> joined = JoinParts(frames, known);
    known.push_back(loop);
    const int match = joined[PartOf(frames, loop.match)],
              query = joined[PartOf(frames, loop.query)];
    if (match == query) continue;
    const std::vector<Pose> before = PosesOf(frames);
    const Pose& T_match_query = loop.closure->T_match_query;
    const Pose motion =
        match < query
            ? LevelMotion(before[loop.query], before[loop.match] * T_match_query, state.gravity())
            : LevelMotion(before[loop.match], before[loop.query] * T_match_query.inverse(),
                          state.gravity());
    for (int f = 0; f < frames.size(); ++f)
      if (joined[PartOf(frames, f)] == std::max(match, query))
        frames.SetPose(f, motion * before[f]);
    MoveObjects(state, before, noise);
  }
}

Pose PlaceBeside(const MapState& state, const Pose& T_odom_cam) {
  const Vec3& forward = state.gravity().forward;
  double end = -std::numeric_limits<double>::infinity();
  for (const FrameRecord& frame : state.frames)
    end = std::max(end, forward.dot(frame.T_world_cam.translation()));
  Pose T_world_cam = T_odom_cam;
  T_world_cam.translation() += (end + kBeside - forward.dot(T_odom_cam.translation())) * forward;
  return T_world_cam;
}

}  // namespace sslcd
