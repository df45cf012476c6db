// SPDX-License-Identifier: BSD-3-Clause
// A drive down a street and back, past parked cars and trees: frames in, loops and poses out.
#include <sslcd/sslcd.h>

#include <cstdio>
#include <random>
#include <vector>

// The frames of the drive, and its true poses. The odometry turns too far, by 1 mrad a step.
std::vector<sslcd::Frame> DriveThereAndBack(std::vector<sslcd::Pose>& truth) {
  std::mt19937 random(1);
  std::vector<sslcd::Detection> objects;  // in the world, which has the axes of the first camera
  for (double z = 5; z < 150; z += 3 + static_cast<double>(random() % 6)) {
    sslcd::Detection object;
    object.label = random() % 2 ? "Car" : "Tree";
    object.dims = object.label == "Car" ? sslcd::Vec3(4.3, 1.8, 1.5) : sslcd::Vec3(.5, .5, 3);
    const double x = random() % 2 ? 6 : -5, yaw = static_cast<double>(random() % 63) / 10;
    object.T_cam_object = sslcd::ToPose({{x, 0.8, z}, yaw}, sslcd::GravityFrame());
    objects.push_back(object);
  }
  std::vector<sslcd::Frame> frames(320);
  sslcd::Pose T_world_cam, T_odom_cam;
  for (sslcd::Frame& frame : frames) {
    frame.index = static_cast<int>(truth.size());
    frame.stamp = 0.1 * frame.index;
    frame.T_odom_cam = T_odom_cam;
    for (sslcd::Detection object : objects) {
      object.T_cam_object = T_world_cam.inverse() * object.T_cam_object;
      const sslcd::Vec3& p = object.T_cam_object.translation();  // right, down, forward
      if (p.z() > std::abs(p.x()) && p.z() < 30) frame.detections.push_back(object);
    }
    truth.push_back(T_world_cam);
    const sslcd::Pose step = frame.index / 20 == 8 ? sslcd::Pose::RotY(M_PI / 20)  // turns round
                                                   : sslcd::Pose::Trans(0, 0, 0.9);
    T_world_cam *= step;
    T_odom_cam *= step * sslcd::Pose::RotY(1e-3);
  }
  return frames;
}

int main() {
  std::vector<sslcd::Pose> truth, odometry;
  const std::vector<sslcd::Frame> frames = DriveThereAndBack(truth);
  for (const sslcd::Frame& frame : frames) odometry.push_back(frame.T_odom_cam);
  // snippet: streaming
  sslcd::MapperContext context;  // up is -y, as in the axes of a camera
  context.labels.Set("Tree", {sslcd::Symmetry::kFull});
  sslcd::Mapper mapper(sslcd::Options(), context);
  for (const sslcd::Frame& frame : frames) {
    const sslcd::FrameReport report = mapper.AddFrame(frame);
    for (const sslcd::LoopClosure& loop : report.changes.loops)  // early ones come again
      if (loop.decision == sslcd::LoopDecision::kAccepted)
        std::printf("loop %d: %d to %d\n", loop.id, loop.query_frame, loop.match_frame);
  }
  mapper.Refine();  // at the end, or now and then

  std::printf("ATE %.2f m, of the odometry %.2f m\n",
              sslcd::ComputeAte(mapper.CameraTrajectory().poses, truth).error.rmse,
              sslcd::ComputeAte(odometry, truth).error.rmse);
}
