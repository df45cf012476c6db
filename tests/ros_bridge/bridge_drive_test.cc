// SPDX-License-Identifier: BSD-3-Clause
// A whole drive as messages of a robot: odometry of base_link in a world with z up, at other stamps
// than the detections; detections in the camera's frame, or in that of a LiDAR.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "loop_drives.h"
#include "ros_bridge/bridge.h"
#include "sslcd/core/error.h"
#include "sslcd/eval/trajectory_error.h"

namespace sslcd::ros_bridge {
namespace {

RawPose RawOf(const Pose& pose) {
  const Eigen::Quaterniond q(pose.so3().matrix());
  const Vec3& t = pose.translation();
  return {{t.x(), t.y(), t.z()}, {q.x(), q.y(), q.z(), q.w()}};
}

// Axes of a camera in those of a body (forward, left, up).
Pose BodyAxes() {
  Eigen::Matrix3d R;
  R << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return Pose(lie::SO3<double>::FromMatrix(R), Vec3::Zero());
}

struct Robot {
  Drives drives = TwoLaps(SecondLap::kOpposite, 0.5, 1);
  Pose T_base_cam = Pose::Trans(0.4, 0.1, 1.2) * BodyAxes();
  Pose T_base_lidar = Pose::Trans(-0.2, 0, 1.8) * Pose::RotZ(0.3);
  bool lidar = false;

  Stamp StampOf(const Frame& frame) const { return std::llround(1e9 * (1000 + frame.stamp)); }
  Pose OdomBase(const Pose& T_world_cam) const {
    return BodyAxes() * T_world_cam * T_base_cam.inverse();
  }
  OdometryMessage Odometry(const Frame& frame) const {
    return {StampOf(frame), "odom", "base_link", RawOf(OdomBase(frame.T_odom_cam)), {}};
  }
  // Between this frame and the next one.
  OdometryMessage OdometryAfter(std::size_t i) const {
    const Frame& a = drives.frames[i];
    const Frame& b = drives.frames[i + 1];
    const Pose::Tangent step = (a.T_odom_cam.inverse() * b.T_odom_cam).Log();
    const Pose T_odom_cam = a.T_odom_cam * Pose::Exp(0.5 * step);
    return {(StampOf(a) + StampOf(b)) / 2, "odom", "base_link", RawOf(OdomBase(T_odom_cam)), {}};
  }
  DetectionsMessage Detections(const Frame& frame) const {
    DetectionsMessage message{StampOf(frame), lidar ? "lidar" : "camera", {}};
    const Pose T_frame_cam = (lidar ? T_base_lidar : T_base_cam).inverse() * T_base_cam;
    for (const Detection& detection : frame.detections) {
      DetectionMessage object;
      object.hypotheses = {{detection.label, detection.score}};
      object.pose = RawOf(T_frame_cam * detection.T_cam_object);
      object.size = {detection.dims.x(), detection.dims.y(), detection.dims.z()};
      message.detections.push_back(object);
    }
    return message;
  }
  // Bases of the true cameras, in the odometry's axes.
  std::vector<Pose> Truth() const {
    std::vector<Pose> truth;
    for (const Pose& pose : drives.world.truth.poses) truth.push_back(OdomBase(pose));
    return truth;
  }
  MapperContext Context() const {
    return {GravityFrame::FromUp({0, 0, 1}), drives.world.labels, {}};
  }
};

double Ate(const std::vector<PathPose>& path, const Robot& robot) {
  std::vector<Pose> poses, truth = robot.Truth();
  for (const PathPose& pose : path) poses.push_back(pose.T_map_base);
  // the first and the last frame have no odometry around them
  truth.erase(truth.begin(), truth.begin() + 1);
  truth.resize(poses.size());
  return ComputeAte(poses, truth).error.rmse;
}

// All messages of a drive. Odometry comes half a frame before and after the detections.
void Play(const Robot& robot, Bridge& bridge) {
  bridge.Add(TransformMessage{"base_link", "camera", RawOf(robot.T_base_cam)});
  bridge.Add(TransformMessage{"base_link", "lidar", RawOf(robot.T_base_lidar)});
  const std::vector<Frame>& frames = robot.drives.frames;
  for (std::size_t i = 0; i + 1 < frames.size(); ++i) {
    bridge.Add(robot.Detections(frames[i]));
    bridge.Add(robot.OdometryAfter(i));
  }
}

BridgeOptions Recorded() {
  BridgeOptions options;
  options.most_frames = 1 << 20;  // played faster than it is mapped
  return options;
}

TEST(BridgeDrive, ClosesLoopsOfARobot) {
  Robot robot;
  Bridge bridge(Recorded(), {}, robot.Context());
  Play(robot, bridge);
  bridge.Wait();
  const BridgeReport report = bridge.Take();
  const int frames = static_cast<int>(robot.drives.frames.size()) - 2;
  EXPECT_EQ(report.frames, frames);
  EXPECT_EQ(bridge.drops()[Drop::kDetectionsWithoutOdometry], 1) << bridge.drops().Text();
  EXPECT_GT(bridge.loops().size(), 5u);
  const std::vector<PathPose> path = bridge.path();
  ASSERT_EQ(static_cast<int>(path.size()), frames);

  std::vector<PathPose> odometry = path;
  for (PathPose& pose : odometry)
    pose.T_map_base = robot.OdomBase(robot.drives.frames.at(pose.frame + 1).T_odom_cam);
  EXPECT_LT(Ate(path, robot), 0.5 * Ate(odometry, robot));

  // The correction takes the newest odometry to the newest pose of the path. The odometry between
  // two messages is interpolated, to some millimetres.
  const Pose T_odom_base = odometry.back().T_map_base;
  EXPECT_LT((*bridge.T_map_odom() * T_odom_base * path.back().T_map_base.inverse()).Log().norm(),
            0.02);
}

TEST(BridgeDrive, LoopsAreMeasuredBetweenBases) {
  Robot robot;
  Bridge bridge(Recorded(), {}, robot.Context());
  Play(robot, bridge);
  bridge.Wait();
  bridge.Take();
  std::map<Stamp, Pose> truth;
  for (const Frame& frame : robot.drives.frames)
    truth[robot.StampOf(frame)] = robot.OdomBase(robot.drives.world.truth.poses[frame.index]);
  ASSERT_FALSE(bridge.loops().empty());
  for (const auto& [id, loop] : bridge.loops()) {
    const Pose T_true = truth.at(loop.match).inverse() * truth.at(loop.query);
    EXPECT_LT((T_true.inverse() * loop.measured.T_a_b).translation().norm(), 2) << id;
    EXPECT_TRUE(Agrees(loop.measured, T_true, 0.9999)) << id;
  }
}

// A LiDAR's frame has the axes of a body; it takes the place of the camera.
TEST(BridgeDrive, ALidarIsACameraWithOtherAxes) {
  Robot robot;
  robot.lidar = true;
  for (const bool own_camera : {false, true}) {
    BridgeOptions options = Recorded();
    options.body_axes = !own_camera;
    if (own_camera) options.camera_frame = "camera";
    Bridge bridge(options, {}, robot.Context());
    Play(robot, bridge);
    bridge.Wait();
    bridge.Take();
    EXPECT_GT(bridge.loops().size(), 5u) << own_camera;
    EXPECT_LT(Ate(bridge.path(), robot), 1) << own_camera;
  }
}

// Time goes back, as when a bag is played in a loop: the second round is a sequence on the same
// map.
TEST(BridgeDrive, ABagPlayedTwiceIsTwoSequences) {
  Robot robot;
  Bridge bridge(Recorded(), {}, robot.Context());
  Play(robot, bridge);
  const std::size_t once = robot.drives.frames.size() - 2;
  Play(robot, bridge);
  bridge.Wait();
  bridge.Take();
  EXPECT_EQ(bridge.path().size(), 2 * once);
  EXPECT_EQ(bridge.drops()[Drop::kFrameRefused], 0);
  int joining = 0;
  for (const auto& [id, loop] : bridge.loops())
    joining +=
        loop.match_frame < static_cast<int>(once) && loop.query_frame >= static_cast<int>(once);
  EXPECT_GT(joining, 5);
  ASSERT_TRUE(bridge.T_map_odom());
}

TEST(BridgeDrive, AFailureOfTheMapperIsTold) {
  Robot robot;
  MapperContext context = robot.Context();
  context.place_matcher = [](const PlaceQuery&) -> std::optional<PlaceAnswer> {
    throw Error(ErrorKind::kUsage, "no matcher");
  };
  Bridge bridge(Recorded(), {}, context);
  Play(robot, bridge);
  bridge.Wait();
  const BridgeReport report = bridge.Take();
  EXPECT_NE(report.failure.find("no matcher"), std::string::npos);
  EXPECT_FALSE(bridge.path().empty()) << "the results so far stay";
}

}  // namespace
}  // namespace sslcd::ros_bridge
