// SPDX-License-Identifier: BSD-3-Clause
// Wrong loops that are accepted first and refused later leave nothing behind.
#include <gtest/gtest.h>

#include "loop_drives.h"
#include "sslcd/loop/layout_match.h"
#include "sslcd/pipeline/mapper.h"
#include "sslcd/pipeline/options.h"

namespace sslcd {
namespace {

// Frames of the second lap: the matcher is wrong up to kWrongUntil, where it has seen the street
// whose objects were moved, and then unsure until it sees other streets.
constexpr int kWrongUntil = 460, kUnsureUntil = 545;

// Twice round the block. Between the laps all objects of the first street are moved 6 m along it.
Drives MovedStreet(std::uint64_t seed) {
  constexpr double kStreetM = 70, kWideM = 12, kMovedM = 6, kBeforeM = 32, kHeadingNoise = 2e-3;
  const sim::Path path = Block();
  sim::World world = EmptyWorld();
  Plant(path, path.length(), 0.5, seed, world);
  Drive(path, 0, 2 * path.length(), world);
  const int moved = static_cast<int>((path.length() - kBeforeM) / kStep);
  const Pose T_start_world = path.CameraAt(0).inverse();
  for (std::size_t i = 0, count = world.objects.size(); i < count; ++i) {
    const Pose T_start_object = T_start_world * world.objects[i].T_world_object[0];
    const Vec3& place = T_start_object.translation();
    if (std::abs(place.x()) > kWideM || place.z() > kStreetM) continue;
    Add(world.objects[i].label, path.CameraAt(0) * Pose::Trans(0, 0, kMovedM) * T_start_object,
        world);
    world.objects.back().first_frame = moved;
    world.objects[i].end_frame = moved;
  }
  return Drives(std::move(world), seed, 30, kHeadingNoise);
}

// A matcher that compares objects alone. It accepts nothing between two frames.
struct Silence {
  int first, end;
};

// Refines before some frame and at the end.
RunResult RunWith(const Silence& silence, const Drives& drives, std::size_t frames,
                  std::size_t refine_at = 0) {
  Options options;
  options.loop.odometry.translation_walk *= 0.25;  // near to what this odometry is
  options.loop.odometry.rotation_walk *= 0.25;
  MapperContext context = drives.Context();
  context.place_matcher = [=](const PlaceQuery& query) -> std::optional<PlaceAnswer> {
    const LayoutAnswer found = MatchLayouts(query.local, query.global);
    if (found.hypotheses.empty()) return std::nullopt;
    PlaceAnswer answer;
    answer.matches = found.hypotheses[0].fit.matches;
    answer.score = found.score;
    answer.accepted = found.decision == LoopDecision::kAccepted && found.score > 5 &&
                      (query.frame < silence.first || query.frame >= silence.end);
    return answer;
  };
  Mapper mapper(options, context);
  RunResult result;
  for (std::size_t i = 0; i < frames; ++i) {
    if (i > 0 && i == refine_at) mapper.Refine(Refinement::kOnTheWay);
    mapper.AddFrame(drives.frames[i]);
    result.odometry.poses.push_back(drives.frames[i].T_odom_cam);
  }
  mapper.Refine();
  result.trajectory = mapper.CameraTrajectory();
  result.loops = mapper.LoopClosures();
  result.objects = mapper.Objects();
  return result;
}

int CountConfirmed(const RunResult& result) {
  return static_cast<int>(std::count_if(
      result.objects.begin(), result.objects.end(),
      [](const MapObject& object) { return object.state == LandmarkState::kConfirmed; }));
}

// The largest distance between the poses of the same frame. [m]
double LargestDistance(const RunResult& a, const RunResult& b) {
  double largest_m = 0;
  for (std::size_t i = 0; i < a.trajectory.size(); ++i)
    largest_m = std::max(
        largest_m,
        (a.trajectory.poses[i].translation() - b.trajectory.poses[i].translation()).norm());
  return largest_m;
}

// Seeds whose wrong loops are refused in the end: in most others 6 m in 200 are no contradiction.
class WithdrawnLoop : public ::testing::TestWithParam<int> {
 protected:
  const Drives drives_ = MovedStreet(static_cast<std::uint64_t>(GetParam()));
  const std::size_t all_ = drives_.frames.size();
  const Silence unsure_{kWrongUntil, kUnsureUntil}, never_wrong_{0, kUnsureUntil};
};

TEST_P(WithdrawnLoop, LeavesNothingBehind) {
  const RunResult halfway = RunWith(unsure_, drives_, kUnsureUntil);
  EXPECT_GT(drives_.Judge(halfway).wrong_loops, 0) << "accepted first";
  const RunResult result = RunWith(unsure_, drives_, all_);
  EXPECT_GT(Accepted(result), 40);
  EXPECT_EQ(drives_.Judge(result).wrong_loops, 0);
  const RunResult never_wrong = RunWith(never_wrong_, drives_, all_);
  EXPECT_EQ(Accepted(result), Accepted(never_wrong));
  EXPECT_EQ(CountConfirmed(result), CountConfirmed(never_wrong));
  EXPECT_LT(LargestDistance(result, never_wrong), 0.1) << "with dead fusions 6 m";
}

TEST_P(WithdrawnLoop, IsWithdrawnAfterARefinementWithIt) {
  const RunResult result = RunWith(unsure_, drives_, all_, kUnsureUntil);
  const RunResult never_wrong = RunWith(never_wrong_, drives_, all_, kUnsureUntil);
  EXPECT_EQ(drives_.Judge(result).wrong_loops, 0);
  EXPECT_EQ(Accepted(result), Accepted(never_wrong));
  EXPECT_LT(LargestDistance(result, never_wrong), 0.1);
}

INSTANTIATE_TEST_SUITE_P(Seeds, WithdrawnLoop, ::testing::Values(1, 3));

}  // namespace
}  // namespace sslcd
