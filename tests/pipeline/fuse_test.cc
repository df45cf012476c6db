// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/fuse.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "pipeline/stretches.h"

namespace sslcd {
namespace {

// A camera drives past one place twice, 300 m of path between the visits: frames 0..9 and 300..309,
// a metre a frame.
struct TwoVisits {
  Options options;
  std::vector<FrameRecord> frames;
  ObjectMap map{GravityFrame{}, LabelTable{}, {}, {}, {}};

  TwoVisits() {
    for (const int first : {0, 300}) {
      for (int i = 0; i < 10; ++i) {
        FrameRecord record;
        record.frame = first + i;
        record.stamp = record.frame;
        record.travelled = record.frame;
        record.T_odom_cam = record.T_world_cam = Pose::Trans(0, 0, i);
        frames.push_back(record);
      }
    }
  }

  // Seen by `count` frames from frame number `first` on, without error.
  LandmarkId Add(const Vec3& position, int first, int count, const std::string& label = "Tree",
                 double yaw = 0) {
    MapLandmark landmark;
    landmark.label = label;
    landmark.symmetry = label == "Tree" ? Symmetry::kFull : Symmetry::kNone;
    landmark.state = LandmarkState::kConfirmed;
    landmark.pose = {position, yaw};
    landmark.dims = label == "Tree" ? Vec3(0.5, 0.5, 3) : Vec3(4, 1.8, 1.5);
    const LandmarkId id{next_id++};
    for (FrameRecord& record : frames) {
      if (record.frame < first || record.frame >= first + count) continue;
      const Pose T_cam_object = record.T_world_cam.inverse() * ToPose(landmark.pose, map.gravity());
      landmark.sightings.push_back(
          {record.frame, record.stamp, 0, 1., T_cam_object, landmark.dims});
      record.detections.push_back({});
      record.matched.push_back(id);
    }
    EXPECT_EQ(map.Insert(landmark).value, id.value);
    return id;
  }
  bool Gone(LandmarkId id) const { return map.landmarks().count(id.value) == 0; }

  int next_id = 1;
};

TEST(FuseMatched, MatchedPairsBecomeOneAndFramesFollow) {
  TwoVisits world;
  const LandmarkId early = world.Add({4, 1, 12}, 0, 8), late = world.Add({4, 1, 13}, 300, 4);
  const Heirs heirs = FuseMatched(world.map, world.frames, {{late, early}}, world.options);
  EXPECT_EQ(heirs.size(), 1u);
  EXPECT_EQ(HeirOf(late, heirs).value, early.value);
  ASSERT_TRUE(world.Gone(late));
  EXPECT_EQ(world.map.at(early).sightings.size(), 12u);
  const double z = world.map.at(early).pose.position.z();
  EXPECT_GT(z, 12.1) << "the mean of both ...";
  EXPECT_LT(z, 12.5) << "... and nearer to the one seen more often";
  for (const FrameRecord& record : world.frames)
    for (const LandmarkId id : record.matched) EXPECT_EQ(id.value, early.value);
}

TEST(FuseMatched, ChainsRepeatsAndNonsense) {
  TwoVisits world;
  const LandmarkId a = world.Add({4, 1, 12}, 0, 3), b = world.Add({4, 1, 14}, 300, 5),
                   c = world.Add({4, 1, 16}, 306, 2);
  const LandmarkId car = world.Add({-4, 1, 12}, 0, 5, "Car");
  const Heirs heirs =
      FuseMatched(world.map, world.frames,
                  {{a, b}, {b, c}, {c, a}, {a, a}, {a, {77}}, {{-1}, {}}, {a, car}}, world.options);
  EXPECT_EQ(heirs.size(), 2u);
  EXPECT_EQ(HeirOf(a, heirs).value, b.value);
  EXPECT_EQ(HeirOf(c, heirs).value, b.value);
  EXPECT_EQ(HeirOf(car, heirs).value, car.value);
  EXPECT_EQ(world.map.landmarks().size(), 2u);
  EXPECT_TRUE(FuseMatched(world.map, world.frames, {}, world.options).empty());
}

TEST(FuseMatched, SeenTogetherOrDrivingIsRefused) {
  TwoVisits world;
  const LandmarkId a = world.Add({4, 1, 12}, 0, 6), b = world.Add({4, 1, 15}, 3, 6);
  const LandmarkId car = world.Add({-4, 1, 12}, 0, 5, "Car"),
                   twin = world.Add({-4, 1, 14}, 300, 5, "Car");
  world.map.SetState(twin, LandmarkState::kDynamic);
  EXPECT_TRUE(FuseMatched(world.map, world.frames, {{a, b}, {car, twin}}, world.options).empty());
}

TEST(FuseMatched, HeadingsMeetHalfATurnApart) {
  TwoVisits world;
  const LandmarkId a = world.Add({-4, 1, 12}, 0, 5, "Car", 0.1);
  const LandmarkId b = world.Add({-4, 1, 12}, 300, 5, "Car", 0.3 + M_PI);
  FuseMatched(world.map, world.frames, {{a, b}}, world.options);
  EXPECT_NEAR(world.map.at(a).pose.yaw, 0.2, 1e-6);
}

TEST(FuseMatched, APairTiesItsSurroundings) {
  TwoVisits world;
  const LandmarkId tree = world.Add({4, 1, 12}, 0, 8), again = world.Add({4.1, 1, 12}, 300, 4);
  const LandmarkId next = world.Add({-4, 1, 15}, 0, 8),
                   next_again = world.Add({-4, 1, 15.1}, 300, 4);
  EXPECT_TRUE(FuseDuplicates(world.map, world.frames, world.options).empty())
      << "drift may have put them there";
  EXPECT_EQ(FuseMatched(world.map, world.frames, {{tree, again}}, world.options).size(), 2u);
  EXPECT_TRUE(world.Gone(next_again));
  EXPECT_FALSE(world.Gone(next));
}

TEST(FuseDuplicates, NeighboursAreNotTwins) {
  TwoVisits world;
  const LandmarkId tree = world.Add({4, 1, 12}, 0, 4), twin = world.Add({4.2, 1, 12}, 4, 3);
  const LandmarkId neighbour = world.Add({4, 1, 13.5}, 4, 3), stick = world.Add({4, 1, 12.3}, 0, 3);
  const LandmarkId other_kind = world.Add({4, 1, 12}, 4, 3, "Car");
  FuseDuplicates(world.map, world.frames, world.options);
  EXPECT_TRUE(world.Gone(twin));
  EXPECT_FALSE(world.Gone(tree));
  EXPECT_FALSE(world.Gone(neighbour)) << "1.5 m off: another tree";
  EXPECT_FALSE(world.Gone(stick)) << "seen together with the tree";
  EXPECT_FALSE(world.Gone(other_kind));
}

TEST(FuseDuplicates, NothingAndNonFiniteDoNoHarm) {
  TwoVisits world;
  EXPECT_TRUE(FuseDuplicates(world.map, world.frames, world.options).empty());
  std::vector<FrameRecord> none;
  EXPECT_TRUE(FuseDuplicates(world.map, none, world.options).empty());
  const LandmarkId a = world.Add({4, 1, 12}, 0, 4), b = world.Add({4, 1, 12}, 4, 3);
  world.map.SetPose(b, {Vec3(4, 1, std::numeric_limits<double>::quiet_NaN()), 0});
  FuseDuplicates(world.map, world.frames, world.options);
  EXPECT_FALSE(world.Gone(a));
  EXPECT_TRUE(world.map.at(a).pose.position.allFinite());
}

TEST(Stretches, NeighboursAndSharedObjectsTie) {
  TwoVisits world;
  const LandmarkId early = world.Add({4, 1, 12}, 0, 3), late = world.Add({4, 1, 12}, 300, 3);
  const LandmarkId soon = world.Add({4, 1, 16}, 5, 3);
  const Stretches apart(world.map, world.frames, 60.);
  EXPECT_TRUE(apart.Tied(world.map.at(early), world.map.at(soon)));
  EXPECT_FALSE(apart.Tied(world.map.at(early), world.map.at(late)));
  EXPECT_FALSE(apart.Tied(world.frames.back(), world.map.at(early)));
  EXPECT_TRUE(Stretches(world.map, world.frames, 0.).Tied(world.map.at(early), world.map.at(late)));
  world.map.Fuse(early, late);
  const Stretches tied(world.map, world.frames, 60.);
  EXPECT_TRUE(tied.Tied(world.frames.back(), world.map.at(soon)))
      << "what was seen about there, too";
  EXPECT_FALSE(tied.Tied(FrameRecord(), MapLandmark()));
}

}  // namespace
}  // namespace sslcd
