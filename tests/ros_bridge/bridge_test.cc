// SPDX-License-Identifier: BSD-3-Clause
// What the bridge makes of messages, good and bad. Frames are counted, loops are not looked for.
#include "ros_bridge/bridge.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "sslcd/core/error.h"

namespace sslcd::ros_bridge {
namespace {

constexpr Stamp kTick = 100000000;  // 0.1 s
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

OdometryMessage OdometryAt(Stamp stamp, double x = 0) {
  OdometryMessage odometry;
  odometry.stamp = stamp;
  odometry.frame = "odom";
  odometry.child_frame = "base_link";
  odometry.pose.position = {x, 0, 0};
  return odometry;
}

DetectionsMessage DetectionsAt(Stamp stamp) {
  DetectionMessage car;
  car.hypotheses = {{"Car", 0.9}};
  car.pose.position = {1, 1, 10};
  car.size = {4, 1.8, 1.5};
  return {stamp, "camera", {car}};
}

class BridgeTest : public ::testing::Test {
 protected:
  BridgeTest() { bridge_.Add(TransformMessage{"base_link", "camera", {}}); }

  // Odometry and detections at ticks `from` to `to`.
  void Drive(int from, int to) {
    for (int i = from; i <= to; ++i) {
      bridge_.Add(OdometryAt(i * kTick, i));
      bridge_.Add(DetectionsAt(i * kTick));
    }
  }
  int Frames() {
    bridge_.Wait();
    return bridge_.Take().frames;
  }
  int operator[](Drop reason) const { return bridge_.drops()[reason]; }

  Bridge bridge_{{}, {}, {GravityFrame::FromUp({0, 0, 1}), {}, {}}};
};

TEST_F(BridgeTest, MakesAFrameOfEachDetections) {
  EXPECT_FALSE(bridge_.T_map_odom());
  Drive(1, 5);
  EXPECT_EQ(Frames(), 5);
  EXPECT_EQ(bridge_.drops(), Drops());
  ASSERT_TRUE(bridge_.T_map_odom());
  EXPECT_LT(bridge_.T_map_odom()->Log().norm(), 1e-9);
  ASSERT_EQ(bridge_.path().size(), 5u);
  EXPECT_EQ(bridge_.path()[2].stamp, 3 * kTick);
  EXPECT_NEAR(bridge_.path()[2].T_map_base.translation().x(), 3, 1e-9);
  EXPECT_EQ(bridge_.newest_odometry(), 5 * kTick);
  EXPECT_EQ(bridge_.odom_frame() + bridge_.base_frame() + bridge_.camera_frame(),
            "odombase_linkcamera");
}

TEST_F(BridgeTest, InterpolatesAndWaitsForTheOdometry) {
  bridge_.Add(DetectionsAt(15 * kTick / 10));
  bridge_.Add(OdometryAt(1 * kTick, 1));
  EXPECT_EQ(Frames(), 0);
  bridge_.Add(OdometryAt(2 * kTick, 2));
  EXPECT_EQ(Frames(), 1);
  EXPECT_NEAR(bridge_.path()[0].T_map_base.translation().x(), 1.5, 1e-9);
}

TEST_F(BridgeTest, DetectionsOutOfOrderWaitInOrder) {
  bridge_.Add(OdometryAt(1 * kTick));
  bridge_.Add(DetectionsAt(3 * kTick));
  bridge_.Add(DetectionsAt(2 * kTick));
  bridge_.Add(DetectionsAt(2 * kTick));
  EXPECT_EQ((*this)[Drop::kDetectionsOutOfOrder], 1) << "twice one stamp";
  bridge_.Add(OdometryAt(4 * kTick));
  EXPECT_EQ(Frames(), 2);
  bridge_.Add(DetectionsAt(25 * kTick / 10));
  bridge_.Add(DetectionsAt(3 * kTick));
  EXPECT_EQ((*this)[Drop::kDetectionsOutOfOrder], 3) << "not newer than a frame";
  EXPECT_EQ(Frames(), 0);
}

TEST_F(BridgeTest, DetectionsWithoutOdometryAreCounted) {
  bridge_.Add(OdometryAt(10 * kTick));
  bridge_.Add(DetectionsAt(9 * kTick));
  EXPECT_EQ((*this)[Drop::kDetectionsWithoutOdometry], 1) << "older than all odometry";
  bridge_.Add(DetectionsAt(12 * kTick));
  bridge_.Add(OdometryAt(20 * kTick));
  EXPECT_EQ((*this)[Drop::kDetectionsWithoutOdometry], 2) << "in a gap";
  EXPECT_EQ(Frames(), 0);
}

TEST_F(BridgeTest, OnlySoManyDetectionsWait) {
  bridge_.Add(OdometryAt(1 * kTick));
  for (int i = 1000; i < 1080; ++i) bridge_.Add(DetectionsAt(i * kTick));  // a clock ahead
  EXPECT_EQ((*this)[Drop::kDetectionsWaited], 30);
  for (int i = 2; i <= 6; ++i) {
    bridge_.Add(DetectionsAt(i * kTick));
    bridge_.Add(OdometryAt(i * kTick));
  }
  EXPECT_EQ(Frames(), 5) << "those that wait in vain do not keep out the others";
}

TEST_F(BridgeTest, OdometryOfAnotherFrameIsNotUsed) {
  bridge_.Add(OdometryAt(1 * kTick));
  OdometryMessage other = OdometryAt(2 * kTick);
  other.child_frame = "gps";
  bridge_.Add(other);
  other = OdometryAt(3 * kTick);
  other.frame = "map";
  bridge_.Add(other);
  other = OdometryAt(4 * kTick);
  other.frame = "/odom";  // the same
  bridge_.Add(other);
  EXPECT_EQ((*this)[Drop::kOdometryOtherFrame], 2);
  EXPECT_EQ(bridge_.newest_odometry(), 4 * kTick);
}

TEST_F(BridgeTest, DetectionsOfAnUnknownFrameAreNotUsed) {
  Drive(1, 2);
  DetectionsMessage other = DetectionsAt(3 * kTick);
  other.frame = "radar";
  bridge_.Add(OdometryAt(4 * kTick));
  bridge_.Add(other);
  EXPECT_EQ((*this)[Drop::kDetectionsOtherFrame], 1);
  bridge_.Add(TransformMessage{"base_link", "radar", {}});
  other.stamp = 4 * kTick;
  bridge_.Add(other);
  EXPECT_EQ(Frames(), 3) << "known now";
}

TEST_F(BridgeTest, AnUnknownFrameAtTheStartIsNotTheCamera) {
  bridge_.Add(OdometryAt(1 * kTick));
  DetectionsMessage other = DetectionsAt(1 * kTick);
  other.frame = "radar";
  bridge_.Add(other);
  EXPECT_EQ(bridge_.camera_frame(), "");
  Drive(2, 4);
  EXPECT_EQ(bridge_.camera_frame(), "camera");
  EXPECT_EQ(Frames(), 3);
}

TEST_F(BridgeTest, BadOdometryIsCounted) {
  OdometryMessage bad = OdometryAt(1 * kTick);
  bad.pose.orientation = {0, 0, 0, 0};
  bridge_.Add(bad);
  bad = OdometryAt(1 * kTick, kNan);
  bridge_.Add(bad);
  EXPECT_EQ((*this)[Drop::kOdometryUnusable], 2);
  Drive(2, 3);
  bridge_.Add(OdometryAt(3 * kTick, 7));
  EXPECT_EQ((*this)[Drop::kOdometryDuplicate], 1);
  bridge_.Add(OdometryAt(2 * kTick, 7));
  EXPECT_EQ((*this)[Drop::kOdometryOutOfOrder], 1);
  bad = OdometryAt(4 * kTick);
  bad.covariance[7] = kNan;
  bridge_.Add(bad);
  EXPECT_EQ((*this)[Drop::kCovarianceUnusable], 1);
  bridge_.Add(DetectionsAt(4 * kTick));
  EXPECT_EQ(Frames(), 3) << "the pose alone is used";
}

TEST_F(BridgeTest, BadObjectsLeaveTheirFrame) {
  bridge_.Add(OdometryAt(1 * kTick));
  DetectionsMessage detections = DetectionsAt(1 * kTick);
  detections.detections.push_back(detections.detections[0]);
  detections.detections[0].pose.orientation = {0, 0, 0, 0};
  bridge_.Add(detections);
  EXPECT_EQ((*this)[Drop::kObject], 1);
  bridge_.Add(OdometryAt(2 * kTick));
  bridge_.Add(DetectionsMessage{2 * kTick, "camera", {}});
  EXPECT_EQ(Frames(), 2) << "nothing seen is a frame, too";
  EXPECT_EQ(bridge_.Snapshot().get().Objects().size(), 1u);
}

TEST_F(BridgeTest, BadTransformsAreCounted) {
  bridge_.Add(TransformMessage{"camera", "base_link", {}});  // a cycle
  bridge_.Add(TransformMessage{"base_link", "camera", {{}, {0, 0, 0, 0}}});
  EXPECT_EQ((*this)[Drop::kTransform], 2);
  Drive(1, 2);
  EXPECT_EQ(Frames(), 2) << "the good one stays";
}

TEST_F(BridgeTest, TimeSetBackBeginsASequence) {
  Drive(100, 103);
  EXPECT_EQ(Frames(), 4);
  EXPECT_TRUE(bridge_.T_map_odom());
  Drive(104, 105);
  bridge_.Add(DetectionsAt(106 * kTick));
  bridge_.Add(OdometryAt(1 * kTick));
  EXPECT_EQ((*this)[Drop::kDetectionsAtRestart], 1);
  EXPECT_FALSE(bridge_.T_map_odom()) << "of the old odometry";
  EXPECT_EQ(Frames(), 2);
  EXPECT_FALSE(bridge_.T_map_odom()) << "these frames were of the old odometry";
  Drive(2, 4);
  EXPECT_EQ(Frames(), 3);
  EXPECT_TRUE(bridge_.T_map_odom());
  EXPECT_EQ(bridge_.drops()[Drop::kFrameRefused], 0);
  EXPECT_EQ(bridge_.path().size(), 9u);
  EXPECT_EQ(bridge_.path()[6].stamp, 2 * kTick);
}

TEST_F(BridgeTest, NothingIsInterpolatedOverALostOdometry) {
  Drive(1, 2);
  OdometryMessage lost = OdometryAt(3 * kTick);
  lost.pose.orientation = {0, 0, 0, 0};
  lost.covariance[0] = lost.covariance[7] = 9999;
  bridge_.Add(lost);
  bridge_.Add(DetectionsAt(3 * kTick));
  bridge_.Add(OdometryAt(4 * kTick, 50));
  EXPECT_EQ((*this)[Drop::kOdometryLost], 1);
  EXPECT_EQ((*this)[Drop::kDetectionsWithoutOdometry], 1);
  bridge_.Add(DetectionsAt(4 * kTick));
  EXPECT_EQ(Frames(), 3);
  // the detections after a lost step are not used, since nothing tells where they are
  for (const MapObject& object : bridge_.Snapshot().get().Objects())
    for (const Observation& observation : object.observations) EXPECT_LT(observation.frame, 2);
}

TEST_F(BridgeTest, DetectionsInQuickSuccessionAreThinned) {
  for (int i = 0; i < 30; ++i) {
    bridge_.Add(OdometryAt(i * kTick / 3));
    bridge_.Add(DetectionsAt(i * kTick / 3));
  }
  EXPECT_EQ(Frames(), 10);
  EXPECT_EQ((*this)[Drop::kDetectionsTooSoon], 20);
}

TEST(Bridge, FramesThatFindTheQueueFullAreCounted) {
  BridgeOptions options;
  options.most_frames = 1;
  options.buffer_s = 1e6;
  Bridge bridge(options, {}, {});
  bridge.Add(TransformMessage{"base_link", "camera", {}});
  // both at once: the second message makes all frames that wait
  bridge.Add(OdometryAt(1 * kTick));
  for (int i = 2; i <= 40; ++i) bridge.Add(DetectionsAt(i * kTick));
  for (int i = 2; i <= 40; ++i) bridge.Add(OdometryAt(i * kTick));
  bridge.Wait();
  const BridgeReport report = bridge.Take();
  EXPECT_EQ(report.frames + bridge.drops()[Drop::kFrameQueueFull], 39);
  EXPECT_EQ(static_cast<int>(bridge.path().size()), report.frames);
}

// Messages in any order, with stamps and values of any kind.
TEST(Bridge, EachDetectionsIsAFrameOrIsCounted) {
  int refused = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    const auto one_in = [&](unsigned n) { return random() % n == 0; };
    BridgeOptions options;
    options.base_frame = "base_link";
    options.most_waiting = 5;
    const bool small_queue = seed % 2 == 1;
    options.most_frames = small_queue ? 3 : 1000;
    Bridge bridge(options, {}, {GravityFrame::FromUp({0, 0, 1}), {}, {}});
    int added = 0, mapped = 0;
    Stamp now = 1000 * kTick;
    for (int i = 0; i < 500; ++i) {
      now += kTick / 4;
      if (one_in(100)) now -= static_cast<Stamp>(random() % 100) * kTick;
      Stamp stamp = now + static_cast<Stamp>(random() % 5) * kTick / 2 - kTick;
      if (one_in(50)) stamp = one_in(2) ? 0 : std::numeric_limits<Stamp>::max() / 4;
      if (one_in(3)) {
        DetectionsMessage detections = DetectionsAt(stamp);
        if (one_in(10)) detections.frame = "radar";
        if (one_in(10)) detections.detections[0].size[0] = kNan;
        bridge.Add(detections);
        ++added;
      } else {
        OdometryMessage odometry = OdometryAt(stamp, one_in(50) ? kNan : 0.1 * i);
        if (one_in(50)) odometry.pose.position[1] = 1e200;
        if (one_in(50)) odometry.child_frame = "gps";
        if (one_in(50)) odometry.covariance[0] = odometry.covariance[7] = one_in(2) ? kNan : 1e5;
        bridge.Add(odometry);
      }
      if (i == 50) bridge.Add(TransformMessage{"base_link", "camera", {}});
      if (one_in(20)) mapped += bridge.Take().frames;
    }
    bridge.StartSequence();
    bridge.Wait();
    mapped += bridge.Take().frames;
    int counted = 0;
    for (const Drop reason :
         {Drop::kDetectionsOtherFrame, Drop::kDetectionsOutOfOrder,
          Drop::kDetectionsWithoutOdometry, Drop::kDetectionsWaited, Drop::kDetectionsTooSoon,
          Drop::kDetectionsAtRestart, Drop::kFrameQueueFull, Drop::kFrameRefused})
      counted += bridge.drops()[reason];
    EXPECT_EQ(mapped + counted, added) << bridge.drops().Text();
    EXPECT_GT(mapped, small_queue ? 0 : 20) << bridge.drops().Text();
    EXPECT_EQ(static_cast<int>(bridge.path().size()), mapped);
    refused += bridge.drops()[Drop::kFrameRefused];
  }
  EXPECT_GT(refused, 0) << "positions of 1e200 m";
}

TEST(Bridge, AllProblemsOfTheOptionsAreListed) {
  EXPECT_TRUE(Check({}).empty());
  BridgeOptions options;
  options.max_gap_s = kNan;
  options.buffer_s = 0;
  options.min_interval_s = -1;
  options.most_waiting = 0;
  options.most_frames = -3;
  options.lost_variance = 0;
  EXPECT_EQ(Check(options).size(), 6u);
  EXPECT_THROW(Bridge(options, {}, {}), Error);
}

}  // namespace
}  // namespace sslcd::ros_bridge
