// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/pipeline/async_mapper.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <future>
#include <map>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <thread>
#include <vector>

#include "loop_drives.h"
#include "pipeline/merge_changes.h"
#include "sslcd/core/error.h"
#include "sslcd/pipeline/options.h"

namespace sslcd {
namespace {

Frame FrameAt(int index) {
  Frame frame;
  frame.index = index;
  frame.stamp = 0.1 * index;
  frame.T_odom_cam = Pose::Trans(0, 0, index);
  return frame;
}

void ExpectIs(const Trajectory& trajectory, const std::map<int, Pose>& poses) {
  ASSERT_EQ(poses.size(), trajectory.size());
  std::size_t i = 0;
  for (const auto& [frame, pose] : poses)
    ASSERT_EQ(pose.matrix(), trajectory.poses[i++].matrix()) << "frame " << frame;
}

TEST(AsyncMapper, IsAMapper) {
  const Drives drives = TwoLaps(SecondLap::kOpposite, 0.5, 1);
  Mapper mapper({}, drives.Context());
  AsyncMapper async({}, drives.Context(), 1 << 20, 0);
  std::map<int, Pose> poses;
  std::map<int, LoopDecision> loops;
  const auto take = [&] {
    const AsyncReport report = async.TakeReport();
    EXPECT_EQ(report.dropped + report.refused, 0);
    for (const FramePose& pose : report.changes.poses) poses[pose.frame] = pose.T_world_cam;
    for (const LoopClosure& loop : report.changes.loops) {
      loops[loop.id] = loop.decision;
      if (loop.early && loop.decision != LoopDecision::kAccepted) loops.erase(loop.id);
    }
    return report.frames;
  };
  int frames = 0;
  for (const Frame& frame : drives.frames) {
    mapper.AddFrame(frame);
    EXPECT_TRUE(async.AddFrame(frame));
    if (frame.index % 10 == 0) frames += take();
  }
  async.Wait();
  frames += take();
  EXPECT_EQ(frames, static_cast<int>(drives.frames.size()));
  ExpectIs(mapper.CameraTrajectory(), poses);

  async.Refine();
  std::future<Mapper> refined = async.Snapshot();
  mapper.Refine();
  EXPECT_EQ(refined.get().Objects().size(), mapper.Objects().size());
  async.Wait();
  take();
  ExpectIs(mapper.CameraTrajectory(), poses);
  const std::vector<LoopClosure> rows = mapper.LoopClosures();
  ASSERT_EQ(rows.size(), loops.size());
  for (const LoopClosure& row : rows) EXPECT_EQ(loops.at(row.id), row.decision);
}

// The mapper is refined between two frames, whenever the refinement ends.
TEST(AsyncMapper, RefinesWhileFramesGoOn) {
  const Drives drives = TwoLaps(SecondLap::kOpposite, 0.5, 1);
  Mapper mapper({}, drives.Context());
  std::mutex waits;  // held until all frames are done
  std::unique_lock held(waits);
  MapperContext context = drives.Context();
  const std::size_t half = drives.frames.size() * 3 / 4;
  std::atomic<bool> refines{false};
  context.view_aligner = [&](const std::vector<ViewPair>& pairs) {
    refines = true;
    const std::lock_guard lock(waits);
    return std::vector<std::optional<RelativePose>>(pairs.size());
  };
  AsyncMapper async({}, context, 1 << 20, 0);
  for (std::size_t i = 0; i < half; ++i) {
    mapper.AddFrame(drives.frames[i]);
    async.AddFrame(drives.frames[i]);
  }
  mapper.Refine(Refinement::kOnTheWay);
  async.Refine(Refinement::kOnTheWay);
  int frames = 0;
  for (std::size_t i = half; i < drives.frames.size(); ++i) {
    mapper.AddFrame(drives.frames[i]);
    async.AddFrame(drives.frames[i]);
  }
  while (frames < static_cast<int>(drives.frames.size())) frames += async.TakeReport().frames;
  EXPECT_FALSE(async.WaitFor(0.01)) << "the refinement is in work";
  std::future<Mapper> snapshot = async.Snapshot();
  held.unlock();
  async.Wait();
  EXPECT_TRUE(refines);
  const AsyncReport report = async.TakeReport();
  EXPECT_EQ(report.failure, "");
  std::map<int, Pose> poses;
  for (const FramePose& pose : report.changes.poses) poses[pose.frame] = pose.T_world_cam;
  ExpectIs(mapper.CameraTrajectory(), poses);
  ExpectIs(snapshot.get().CameraTrajectory(), poses);
}

// Frames may be farther apart than that.
TEST(AsyncMapper, RefinesByItselfAfterShortPathsToo) {
  const Drives drives = TwoLaps(SecondLap::kOpposite, 0.5, 1);
  const auto last = [&](double refine_every_m) {
    AsyncMapper async({}, drives.Context(), 1 << 20, refine_every_m);
    for (std::size_t i = 0; i < drives.frames.size() * 5 / 8; ++i) async.AddFrame(drives.frames[i]);
    return async.Snapshot().get().CameraTrajectory().poses.back();
  };
  EXPECT_NE(last(0.1).matrix(), last(0).matrix());
}

TEST(AsyncMapper, AnExceptionWithoutAMessageIsAFailure) {
  const Drives drives = TwoLaps(SecondLap::kSame, 0.5, 1);
  MapperContext context = drives.Context();
  context.place_matcher = [](const PlaceQuery&) -> std::optional<PlaceAnswer> {
    throw std::runtime_error("");
  };
  AsyncMapper async({}, context, 1 << 20);
  for (const Frame& frame : drives.frames) async.AddFrame(frame);
  async.Wait();
  EXPECT_NE(async.TakeReport().failure, "");
}

TEST(AsyncMapper, ASequenceMayStartWhileARefinementEnds) {
  AsyncMapper async({}, {});
  for (int i = 0; i < 20; ++i) async.AddFrame(FrameAt(i));
  async.Refine();
  async.StartSequence();
  async.Wait();
  Frame first = FrameAt(20);
  first.stamp = 0;
  async.AddFrame(first);
  async.Wait();
  EXPECT_EQ(async.TakeReport().refused, 0);
}

TEST(AsyncMapper, RefinesByItselfAfterALoop) {
  const Drives drives = TwoLaps(SecondLap::kOpposite, 0.5, 1);
  const auto drive = [&](double refine_every_m, bool in_steps) {
    AsyncMapper async({}, drives.Context(), 1 << 20, refine_every_m);
    for (const Frame& frame : drives.frames) {
      async.AddFrame(frame);
      if (in_steps) async.Wait();
    }
    return async.Snapshot().get().CameraTrajectory();
  };
  const Trajectory refined = drive(50, false);
  std::map<int, Pose> poses;
  for (std::size_t i = 0; i < refined.size(); ++i) poses[drives.frames[i].index] = refined.poses[i];
  ExpectIs(drive(50, true), poses);  // however long a refinement takes
  EXPECT_NE(refined.poses.back().matrix(), drive(0, false).poses.back().matrix());
  EXPECT_THROW(AsyncMapper({}, drives.Context(), 64, -1), Error);
  EXPECT_THROW(AsyncMapper({}, drives.Context(), 64, std::nan("")), Error);
}

TEST(AsyncMapper, ABadFrameIsCountedWithItsReason) {
  AsyncMapper async({}, {});
  async.AddFrame(FrameAt(3));
  async.AddFrame(FrameAt(2));
  async.AddFrame(FrameAt(4));
  async.Wait();
  const AsyncReport report = async.TakeReport();
  EXPECT_EQ(report.frames, 2);
  EXPECT_EQ(report.refused, 1);
  EXPECT_NE(report.refusal.find("frame 2"), std::string::npos);
  EXPECT_TRUE(report.failure.empty());
}

// A mapper whose host's matcher has thrown is no longer as it was.
TEST(AsyncMapper, AnExceptionOfTheHostEndsItAndIsTold) {
  const Drives drives = TwoLaps(SecondLap::kSame, 0.5, 1);
  for (const bool standard : {true, false}) {
    MapperContext context = drives.Context();
    context.place_matcher = [standard](const PlaceQuery&) -> std::optional<PlaceAnswer> {
      if (standard) throw Error(ErrorKind::kUsage, "the matcher gives up");
      throw 1;
    };
    AsyncMapper async({}, context, 1 << 20);
    for (const Frame& frame : drives.frames) async.AddFrame(frame);
    async.Wait();
    const AsyncReport report = async.TakeReport();
    EXPECT_EQ(report.refused, 0);
    EXPECT_NE(report.failure.find(standard ? "gives up" : "exception"), std::string::npos);
    EXPECT_FALSE(async.AddFrame(drives.frames.back()));
  }
}

TEST(AsyncMapper, EndsWithFramesInTheQueue) {
  const Drives drives = TwoLaps(SecondLap::kSame, 0.5, 1);
  std::future<Mapper> never;
  {
    AsyncMapper async({}, drives.Context(), 1 << 20);
    for (const Frame& frame : drives.frames) async.AddFrame(frame);
    never = async.Snapshot();
  }
  EXPECT_THROW(never.get(), std::future_error);
}

TEST(AsyncMapper, ManyThreadsMayCallIt) {
  AsyncMapper async({}, {}, 8);
  std::vector<std::thread> threads;
  for (int t = 0; t < 3; ++t) {
    threads.emplace_back([&] {
      for (int i = 0; i < 50; ++i) {
        async.TakeReport();
        async.Snapshot();
        async.Refine();
      }
    });
  }
  for (int i = 0; i < 200; ++i) async.AddFrame(FrameAt(i));
  for (std::thread& thread : threads) thread.join();
  async.Wait();
  EXPECT_EQ(async.TakeReport().failure, "");
}

TEST(AsyncMapper, RefusesWhatAMapperRefuses) {
  MapperContext context;
  context.camera = Camera();
  EXPECT_THROW(AsyncMapper({}, context), Error);
}

TEST(MergeChanges, NewerPosesAndDecisionsReplaceOlderOnes) {
  MapChanges changes, newer;
  changes.poses = {{1, 0.1, Pose()}, {2, 0.2, Pose()}, {3, 0.3, Pose()}};
  changes.loops.resize(2);
  changes.loops[1].id = 1;
  newer.T_world_odom = Pose::Trans(1, 0, 0);
  newer.scale = 1.02;
  newer.poses = {{2, 0.2, Pose::Trans(0, 1, 0)}, {3, 0.3, Pose()}, {4, 0.4, Pose()}};
  newer.loops.resize(2);
  newer.loops[0].id = 1;
  newer.loops[0].decision = LoopDecision::kAccepted;
  newer.loops[1].id = 2;
  MergeChanges(newer, changes);
  ASSERT_EQ(changes.poses.size(), 4u);
  EXPECT_EQ(changes.poses[1].T_world_cam.translation(), Vec3(0, 1, 0));
  EXPECT_EQ(changes.poses[3].frame, 4);
  ASSERT_EQ(changes.loops.size(), 3u);
  EXPECT_EQ(changes.loops[1].decision, LoopDecision::kAccepted);
  EXPECT_EQ(changes.T_world_odom.translation(), Vec3(1, 0, 0));
  MergeChanges({}, changes);
  EXPECT_EQ(changes.T_world_odom.translation(), Vec3(1, 0, 0)) << "nothing has changed";
  EXPECT_EQ(changes.scale, 1.02);
  EXPECT_EQ(changes.poses.size(), 4u);
}

}  // namespace
}  // namespace sslcd
