// SPDX-License-Identifier: BSD-3-Clause
// Drives, changes of them that mean the same to a mapper, and what comes of both.
#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "sim/halv.h"
#include "sim/random.h"
#include "sslcd/eval/trajectory_error.h"
#include "sslcd/pipeline/run.h"

namespace sslcd {

/// The input of a run. `truth` is for the judge: T_world_cam by frame number.
struct Drive {
  std::vector<Frame> frames;
  MapperContext context;
  std::vector<Pose> truth;
};

inline Drive HalvDrive(int case_number, std::uint64_t seed) {
  sim::HalvOptions options;
  options.scene.case_number = case_number;
  const sim::HalvSequence halv = sim::MakeHalv(seed, options);
  const sim::World& world = halv.scene.world;
  return {sim::MakeFrames(halv.odometry, halv.detections),
          {world.gravity, world.labels, world.camera},
          world.truth.poses};
}

/// The odometry's world is another one.
inline Drive Moved(Drive drive, const Pose& T_new_old) {
  drive.context.gravity = GravityFrame::FromUp(T_new_old.so3() * drive.context.gravity.up);
  for (Frame& frame : drive.frames) frame.T_odom_cam = T_new_old * frame.T_odom_cam;
  return drive;
}

inline Drive WithStampsLater(Drive drive, double by_s) {
  for (Frame& frame : drive.frames) frame.stamp += by_s;
  return drive;
}

/// The detections of each frame come in another order.
inline Drive Shuffled(Drive drive, std::uint64_t seed) {
  sim::Random random(seed, 21);
  for (Frame& frame : drive.frames)
    for (std::size_t i = frame.detections.size(); i > 1; --i)
      std::swap(
          frame.detections[i - 1],
          frame.detections[static_cast<std::size_t>(random.Uniform() * static_cast<double>(i))]);
  return drive;
}

/// Each label gets another name; their alphabetical order turns round.
inline Drive Renamed(Drive drive) {
  std::map<std::string, std::string> names;
  for (const Frame& frame : drive.frames)
    for (const Detection& detection : frame.detections) names[detection.label];
  int number = static_cast<int>(names.size());
  LabelTable labels;
  for (auto& [label, name] : names) {
    name = "thing " + std::to_string(100 + --number);
    labels.Set(name, drive.context.labels[label]);
  }
  for (Frame& frame : drive.frames)
    for (Detection& detection : frame.detections) detection.label = names[detection.label];
  drive.context.labels = labels;
  return drive;
}

/// Some frames never arrive.
inline Drive WithoutSome(Drive drive, double share, std::uint64_t seed) {
  sim::Random random(seed, 22);
  drive.frames.erase(std::remove_if(drive.frames.begin() + 1, drive.frames.end(),
                                    [&](const Frame&) { return random.Chance(share); }),
                     drive.frames.end());
  return drive;
}

/// Half the frame rate.
inline Drive EveryOther(Drive drive) {
  std::vector<Frame> kept;
  for (std::size_t i = 0; i < drive.frames.size(); i += 2) kept.push_back(drive.frames[i]);
  drive.frames = kept;
  return drive;
}

/// What came of a run.
struct Outcome {
  std::map<std::pair<int, int>, Pose> loops;  ///< accepted: T_match_query by (match, query)
  std::map<int, Pose> poses;                  ///< T_world_cam by frame number
  int wrong = 0;                              ///< loops as off as SequenceMetricOptions says
  double ate_m = 0, odometry_ate_m = 0;       ///< after SE(3)
  int landmarks = 0;
};

inline bool IsWrong(const Pose& T_match_query, const Pose& truth) {
  const Pose error = truth.inverse() * T_match_query;
  const Vec3 off = T_match_query.translation() - truth.translation();
  return !(Vec2(off.x(), off.z()).norm() < 5 && std::abs(off.y()) < 1.5 &&
           error.so3().Log().norm() < 5 * M_PI / 180);
}

inline Outcome Judge(const Drive& drive, const RunResult& result) {
  Outcome outcome;
  for (const LoopClosure& loop : result.loops) {
    if (loop.decision != LoopDecision::kAccepted) continue;
    outcome.loops[{loop.match_frame, loop.query_frame}] = loop.T_match_query;
    outcome.wrong += IsWrong(loop.T_match_query, drive.truth.at(loop.match_frame).inverse() *
                                                     drive.truth.at(loop.query_frame));
  }
  std::vector<Pose> truth;
  for (std::size_t i = 0; i < result.frames.size(); ++i) {
    outcome.poses[result.frames[i]] = result.trajectory.poses[i];
    truth.push_back(drive.truth.at(result.frames[i]));
  }
  outcome.ate_m = ComputeAte(result.trajectory.poses, truth, Alignment::kSe3).error.rmse;
  outcome.odometry_ate_m = ComputeAte(result.odometry.poses, truth, Alignment::kSe3).error.rmse;
  outcome.landmarks = static_cast<int>(result.objects.size());
  return outcome;
}

inline Outcome RunAndJudge(const Drive& drive) {
  return Judge(drive, RunSequence(drive.frames, drive.context, {}));
}

/// Two outcomes of one drive; `T_old_new` takes back a change of the world.
struct Difference {
  int loops = 0, loops_changed = 0, in_common = 0;
  double farthest_m = 0;       ///< between the positions of a frame
  double farthest_loop_m = 0;  ///< between two measurements of a loop
};

inline Difference Compare(const Outcome& old, const Outcome& changed,
                          const Pose& T_old_new = Pose()) {
  Difference difference;
  difference.loops = static_cast<int>(old.loops.size());
  difference.loops_changed = static_cast<int>(changed.loops.size());
  for (const auto& [frames, T_match_query] : changed.loops) {
    const auto same = old.loops.find(frames);
    if (same == old.loops.end()) continue;
    ++difference.in_common;
    difference.farthest_loop_m =
        std::max(difference.farthest_loop_m,
                 (same->second.translation() - T_match_query.translation()).norm());
  }
  for (const auto& [frame, T_world_cam] : changed.poses)
    difference.farthest_m = std::max(
        difference.farthest_m,
        (old.poses.at(frame).translation() - T_old_new * T_world_cam.translation()).norm());
  return difference;
}

}  // namespace sslcd
