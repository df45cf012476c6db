// SPDX-License-Identifier: BSD-3-Clause
// A host program: one parked car, seen ten times on the way past it.
#include <cstdio>
#include <vector>

#include "sslcd/core/pose.h"
#include "sslcd/pipeline/run.h"

int main() {
  std::vector<sslcd::Frame> frames(10);
  for (int i = 0; i < 10; ++i) {
    sslcd::Frame& frame = frames[i];
    frame.index = i;
    frame.stamp = 0.1 * i;
    frame.T_odom_cam.translation().z() = i;  // 1 m a frame, along the camera's axis
    sslcd::Detection car;
    car.row = i;
    car.label = "Car";
    car.T_cam_object = sslcd::ToPose({{3., 1., 20. - i}, 0.}, sslcd::GravityFrame());
    car.dims = sslcd::Vec3(4, 1.7, 1.5);
    frame.detections.push_back(car);
  }
  const sslcd::RunResult result = sslcd::RunSequence(frames, {}, sslcd::Options());
  std::printf("%zu frames, %zu objects\n", result.frames.size(), result.objects.size());
  return result.frames.size() == 10 && result.objects.size() == 1 ? 0 : 1;
}
