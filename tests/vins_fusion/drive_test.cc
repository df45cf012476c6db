// SPDX-License-Identifier: BSD-3-Clause
// A simulated drive through a stand-in for VINS-Fusion's loop_fusion to which apply.sh has been
// applied.
#include <gtest/gtest.h>

#include "../support/temp_folder.h"
#include "loop_drives.h"
#include "pose_graph_node.h"
#include "sim/write_sequence.h"
#include "sslcd/eval/trajectory_error.h"

namespace sslcd::vins {
namespace {

constexpr double kVinssGateDeg = 30;  // its own loops turn less

// VINS's world and body with respect to the drive's (x right, y down, z forward).
struct Mounting {
  bool imu = false;
  Pose T_vins_world, T_body_cam;
};

Mounting WithImu() {
  const lie::SO3<double> to_up =
      lie::SO3<double>::RotZ(-M_PI / 2) * lie::SO3<double>::RotX(-M_PI / 2);
  Mounting setup{true, Pose(lie::SO3<double>::RotZ(0.3) * to_up, {3, 1, 0}), {}};
  setup.T_body_cam = Pose(to_up, {0.4, 0.1, 0.2});
  return setup;
}

std::string ConfigText(const Mounting& setup) {
  const auto T = setup.T_body_cam.matrix3x4();
  std::ostringstream text;
  text.precision(17);
  text << "%YAML:1.0\nimu: " << setup.imu << "\ncam0_calib: \"cam0.yaml\"\n"
       << "sslcd_detections: \"drive\"\n"
       << "body_T_cam0: !!opencv-matrix\n   rows: 4\n   cols: 4\n   dt: d\n   data: [";
  for (int i = 0; i < 12; ++i) text << T(i / 4, i % 4) << ", ";
  text << "0, 0, 0, 1]\n";
  return text.str();
}

// A drive on disk, its configuration, and what VINS's estimator would publish.
struct Replay {
  TempFolder folder;
  Drives drives = TwoLaps(SecondLap::kOpposite, 0.5, 1);
  Mounting setup;
  NodeInput input;

  explicit Replay(const Mounting& s) : setup(s) {
    Trajectory odometry;
    sim::SimulatedDetections detections{{}, drives.identities};
    for (const Frame& frame : drives.frames) {
      odometry.stamps.push_back(frame.stamp);
      odometry.poses.push_back(frame.T_odom_cam);
      detections.frames.push_back(frame.detections);
    }
    sim::WriteSequence(drives.world, odometry, detections, folder.In("drive"));
    const Camera& camera = drives.world.camera;
    folder.Write("cam0.yaml",
                 "%YAML:1.0\n---\nmodel_type: PINHOLE\nimage_width: 1242\nimage_height: 375\n"
                 "projection_parameters:\n   fx: " +
                     std::to_string(camera.fx) + "\n   fy: " + std::to_string(camera.fy) +
                     "\n   cx: " + std::to_string(camera.cx) +
                     "\n   cy: " + std::to_string(camera.cy) + "\n");
    input.config_file = folder.Write("vins.yaml", ConfigText(setup));
    input.use_imu = setup.imu;
    input.tic = setup.T_body_cam.translation();
    input.qic = setup.T_body_cam.so3().matrix();
    for (std::size_t i = 0; i < drives.frames.size(); ++i) {
      if (i % 17 == 16) continue;  // VINS drops keyframes that it has no time for
      const Frame& frame = drives.frames[i];
      const Pose T = setup.T_vins_world * frame.T_odom_cam * setup.T_body_cam.inverse();
      input.messages.push_back({frame.stamp, T.translation(), T.so3().matrix()});
    }
  }

  Trajectory Cameras(const ::PoseGraph& graph, bool optimised) const {
    Trajectory cameras;
    for (const KeyFrame* keyframe : graph.all()) {
      const Matrix3d& R = optimised ? keyframe->R_w_i : keyframe->origin_vio_R;
      const Vector3d& t = optimised ? keyframe->T_w_i : keyframe->origin_vio_T;
      cameras.stamps.push_back(keyframe->time_stamp);
      cameras.poses.push_back(Pose(lie::SO3<double>::FromMatrix(R), t) * setup.T_body_cam);
    }
    return cameras;
  }
  double Ate(const ::PoseGraph& graph, bool optimised) const {
    const MatchedPoses poses = MatchByStamp(Cameras(graph, optimised), drives.world.truth);
    return ComputeAte(poses.est, poses.ref, Alignment::kSim3).error.rmse;
  }
};

double TurnOf(const KeyFrame& keyframe) {
  return 2 * std::acos(std::min(1., std::abs(keyframe.loop_info[3]))) * 180 / M_PI;
}

int CountLoops(const ::PoseGraph& graph, double least_deg) {
  int count = 0;
  for (const KeyFrame* keyframe : graph.all())
    count += keyframe->has_loop && TurnOf(*keyframe) > least_deg;
  return count;
}

void WaitForMapper(::PoseGraph& graph) { graph.object_loops->Wait(); }

// Most accepted loops are used, all of them beyond VINS's gate, and the trajectory is mended.
void ExpectMended(const Mounting& setup) {
  const Replay replay(setup);
  int accepted = 0, used = 0, beyond_gate = 0;
  ::PoseGraph* graph = nullptr;
  double before = 0, after = 0;
  RunNode(replay.input, WaitForMapper, [&](::PoseGraph& at_end) {
    graph = &at_end;
    accepted = graph->object_loops->book().accepted();
    used = CountLoops(*graph, 0);
    beyond_gate = CountLoops(*graph, kVinssGateDeg);
    before = replay.Ate(*graph, false);
    graph->stop();
    after = replay.Ate(*graph, true);
  });
  std::printf("%d loops accepted, %d used, %d beyond %g degrees, ATE %.3f -> %.3f m\n", accepted,
              used, beyond_gate, kVinssGateDeg, before, after);
  EXPECT_GE(beyond_gate, 5);
  EXPECT_GE(used, 0.9 * accepted);
  EXPECT_LE(after, 0.45 * before);
}

TEST(VinsDrive, IsMendedWithAnImu) { ExpectMended(WithImu()); }

TEST(VinsDrive, IsMendedWithoutAnImu) { ExpectMended(Mounting()); }

TEST(VinsDrive, AWithdrawnLoopLeavesThePoseGraph) {
  const Replay replay(WithImu());
  RunNode(replay.input, WaitForMapper, [&](::PoseGraph& graph) {
    LoopFusion& fusion = *graph.object_loops;
    ASSERT_FALSE(fusion.book().edges().empty());
    const std::map<int, LoopEdge> edges = fusion.book().edges();
    const int before = CountLoops(graph, 0);
    MapChanges changes;
    for (const auto& [cur, edge] : edges) {
      LoopClosure loop;
      loop.id = edge.id;
      loop.decision = LoopDecision::kAmbiguous;
      changes.loops.push_back(loop);
    }
    EXPECT_GT(before, 0);
    fusion.Use(changes);
    EXPECT_EQ(CountLoops(graph, 0), static_cast<int>(fusion.book().edges().size()));
    EXPECT_LT(CountLoops(graph, 0), before / 2);
    for (const auto& [cur, edge] : fusion.book().edges())
      for (const auto& [old_cur, old] : edges) EXPECT_NE(edge.id, old.id);
  });
}

// The second lap is another sequence, whose odometry begins elsewhere. VINS moves all of it.
void ExpectJoined(const Mounting& mounting, const lie::SO3<double>& turn) {
  Replay replay(mounting);
  const Pose elsewhere(turn, {40, -7, 2});
  const std::size_t half = 480;  // the camera has turned round
  for (std::size_t i = half; i < replay.input.messages.size(); ++i) {
    PoseMessage& message = replay.input.messages[i];
    const Pose T = elsewhere * Pose(lie::SO3<double>::FromMatrix(message.R), message.t);
    message.t = T.translation();
    message.R = T.so3().matrix();
    message.sequence = 2;
  }
  double ate = 0;
  int between = 0;
  Pose moved;
  RunNode(replay.input, WaitForMapper, [&](::PoseGraph& graph) {
    for (const KeyFrame* keyframe : graph.all())
      between += keyframe->has_loop && keyframe->sequence == 2 && keyframe->loop_index < 400;
    moved = Pose(lie::SO3<double>::FromMatrix(graph.w_r_vio), graph.w_t_vio);
    graph.stop();
    ate = replay.Ate(graph, true);
  });
  EXPECT_GE(between, 5);
  EXPECT_LT(ate, 2);
  const Pose drift = moved * elsewhere;
  EXPECT_LT(drift.so3().Log().norm(), 0.2);
  EXPECT_LT(drift.translation().norm(), 10);
}

TEST(VinsDrive, TwoSequencesAreJoinedWithAnImu) {
  ExpectJoined(WithImu(), lie::SO3<double>::RotZ(1.2));
}

TEST(VinsDrive, TwoSequencesAreJoinedWithoutAnImu) {
  ExpectJoined(Mounting(), lie::SO3<double>::RotY(1.2));
}

TEST(VinsDrive, IsLeftAloneWithoutDetections) {
  const Replay replay(WithImu());
  std::string config = ConfigText(WithImu());
  NodeInput input = replay.input;
  input.config_file = replay.folder.Write(
      "off.yaml", config.replace(config.find("sslcd_detections"), 16, "other_detections"));
  RunNode(
      input, [](::PoseGraph&) {},
      [](::PoseGraph& graph) {
        EXPECT_EQ(graph.object_loops, nullptr);
        EXPECT_EQ(CountLoops(graph, 0), 0);
      });
}

}  // namespace
}  // namespace sslcd::vins
