// SPDX-License-Identifier: BSD-3-Clause
// Several sequences on one map: each has an odometry with an origin and a heading of its own.
#include <gtest/gtest.h>

#include "loop_drives.h"
#include "sslcd/eval/trajectory_error.h"
#include "sslcd/pipeline/mapper.h"

namespace sslcd {
namespace {

// A path with objects along it.
struct Site {
  sim::Path path;
  sim::World world;
};

Site BlockSite(std::uint64_t seed) {
  Site site{Block(), EmptyWorld()};
  Plant(site.path, site.path.length(), 0.5, seed, site.world);
  return site;
}

Drives Session(Site site, double from_m, double to_m, std::uint64_t seed) {
  Drive(site.path, from_m, to_m, site.world);
  return Drives(std::move(site.world), seed);
}

// A mapper that gets one session after the other.
struct Sessions {
  Mapper mapper;
  std::vector<Pose> truth;
  std::vector<int> session;    // of each frame
  std::vector<MapPart> parts;  // what a host knows

  explicit Sessions(const Drives& first, const Options& options = {})
      : mapper(options, first.Context()) {
    Add(first);
  }

  void Add(const Drives& drives) {
    const int number = truth.empty() ? 0 : session.back() + 1;
    if (number > 0) mapper.StartSequence();
    for (Frame frame : drives.frames) {
      truth.push_back(drives.world.truth.poses[static_cast<std::size_t>(frame.index)]);
      frame.index = static_cast<int>(session.size());
      session.push_back(number);
      const MapChanges changes = mapper.AddFrame(frame).changes;
      if (!changes.parts.empty()) parts = changes.parts;
    }
  }
  std::vector<int> JoinedWith() const {
    std::vector<int> all;
    for (const MapPart& part : mapper.Parts()) all.push_back(part.joined_with);
    return all;
  }
  double Ate() const {
    return ComputeAte(mapper.CameraTrajectory().poses, truth, Alignment::kSe3).error.rmse;
  }
  void ExpectNoWrongLoop() const {
    for (const LoopClosure& loop : mapper.LoopClosures()) {
      if (loop.decision != LoopDecision::kAccepted) continue;
      const Pose T_true = truth[loop.match_frame].inverse() * truth[loop.query_frame];
      EXPECT_LT((T_true.inverse() * loop.T_match_query).translation().norm(), 3)
          << session[loop.match_frame] << " and " << session[loop.query_frame];
    }
  }
};

TEST(Sessions, AnyOrderGivesOneMap) {
  const Site site = BlockSite(1);
  const std::vector<Drives> all{Session(site, 0, 200, 1), Session(site, 120, 330, 2),
                                Session(site, 260, 60, 3)};
  for (const std::vector<int>& order : {std::vector<int>{0, 1, 2}, {2, 1, 0}, {1, 2, 0}}) {
    Sessions sessions(all[order[0]]);
    sessions.Add(all[order[1]]);
    sessions.Add(all[order[2]]);
    sessions.mapper.Refine();
    EXPECT_EQ(sessions.JoinedWith(), (std::vector<int>{0, 0, 0})) << order[0];
    EXPECT_LT(sessions.Ate(), 0.6) << order[0];
    sessions.ExpectNoWrongLoop();
    const Pose first = sessions.mapper.CameraTrajectory().poses[0];
    EXPECT_LT((all[order[0]].frames[0].T_odom_cam.inverse() * first).Log().norm(), 1e-6)
        << "it defines the world";
  }
}

// Odometry in parts is no trajectory that stays unless the result is surely better.
TEST(Sessions, WhatLoopsJoinNeedsNoCertainty) {
  const Site site = BlockSite(1);
  std::vector<std::vector<Pose>> results;
  for (const double least_probability : {0.5, 1 - 1e-15}) {
    Options options;
    options.refine.least_probability = least_probability;
    Sessions sessions(Session(site, 0, 100, 1), options);
    sessions.Add(Session(site, 40, 140, 2));
    EXPECT_EQ(sessions.JoinedWith(), (std::vector<int>{0, 0}));
    sessions.mapper.Refine();
    EXPECT_GT(sessions.mapper.improvement().horizontal, 0.5);
    EXPECT_LT(sessions.mapper.improvement().horizontal, 1 - 1e-15);
    results.push_back(sessions.mapper.CameraTrajectory().poses);
  }
  for (std::size_t f = 0; f < results[0].size(); ++f)
    EXPECT_EQ(results[0][f].matrix(), results[1][f].matrix()) << f;
}

TEST(Sessions, AnUnrelatedOneStaysApart) {
  Sessions sessions(Session(BlockSite(1), 0, 200, 1));
  sessions.Add(Session(BlockSite(2), 0, 200, 2));
  sessions.mapper.Refine();
  EXPECT_EQ(sessions.JoinedWith(), (std::vector<int>{0, 1}));
  const std::vector<Pose> poses = sessions.mapper.CameraTrajectory().poses;
  for (std::size_t f = 0; f < poses.size(); ++f)
    if (sessions.session[f] == 1) {
      EXPECT_GT((poses[f].translation() - poses[0].translation()).norm(), 4000);
    }
}

TEST(Sessions, ALaterOneJoinsTwo) {
  const Site site = BlockSite(1);
  Sessions sessions(Session(site, 0, 100, 1));
  sessions.Add(Session(site, 170, 270, 2));
  EXPECT_EQ(sessions.JoinedWith(), (std::vector<int>{0, 1}));
  EXPECT_EQ(sessions.parts, sessions.mapper.Parts());
  sessions.Add(Session(site, 30, 250, 3));
  EXPECT_EQ(sessions.JoinedWith(), (std::vector<int>{0, 0, 0}));
  EXPECT_EQ(sessions.parts, sessions.mapper.Parts());
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(sessions.parts[k].sequence, k);
    EXPECT_EQ(sessions.session[sessions.parts[k].first_frame], k);
  }
  sessions.mapper.Refine();
  EXPECT_LT(sessions.Ate(), 1.2);
  sessions.ExpectNoWrongLoop();
}

// The objects of the first 140 m stand again 400 m farther on.
Site SiteWithCopy() {
  Site site{sim::Path({{720, 0}}), EmptyWorld()};
  Plant(site.path, 140, 0.5, 1, site.world);
  const std::vector<sim::WorldObject> original = site.world.objects;
  sim::World rest = EmptyWorld();
  Plant(site.path, 720, 0.5, 2, rest);
  for (const sim::WorldObject& object : rest.objects) {
    const double z = object.PoseAt(0).translation().z();
    if ((z > 140 && z < 400) || z > 540) Add(object.label, object.PoseAt(0), site.world);
  }
  for (const sim::WorldObject& object : original)
    Add(object.label, Pose::Trans(0, 0, 400) * object.PoseAt(0), site.world);
  return site;
}

TEST(Sessions, ACopyOfThePlaceDoesNotFoolIt) {
  const Site site = SiteWithCopy();
  Sessions sessions(Session(site, 0, 700, 1));
  sessions.Add(Session(site, 0, 90, 2));
  sessions.mapper.Refine(Refinement::kOnTheWay);
  EXPECT_EQ(sessions.JoinedWith(), (std::vector<int>{0, 1})) << "nothing tells the copies apart";
  sessions.Add(Session(site, 90, 320, 3));
  sessions.Add(Session(site, 320, 30, 4));
  sessions.mapper.Refine();
  const std::vector<int> joined = sessions.JoinedWith();
  EXPECT_EQ(joined[2], 0) << "it went on to where the copies end";
  EXPECT_EQ(joined[3], 0) << "it came from there";
  sessions.ExpectNoWrongLoop();
}

}  // namespace
}  // namespace sslcd
