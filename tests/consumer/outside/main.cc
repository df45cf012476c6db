// SPDX-License-Identifier: BSD-3-Clause
// A host program: one parked car, seen ten times on the way past it.
#include <sslcd/sslcd.h>
#include <cstdio>
#include <string>
#include <vector>

namespace {

// Exceptions cross the boundary of a shared library.
bool Refuses() {
  try {
    sslcd::LoadConfigFile("missing.yaml", [](sslcd::FieldVisitor&) {});
  } catch (const sslcd::Error& error) {
    return error.kind() == sslcd::ErrorKind::kBadInput;
  }
  return false;
}

}  // namespace

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
  std::printf("sslcd %s: %zu frames, %zu objects\n", SSLCD_VERSION, result.frames.size(),
              result.objects.size());
  return Refuses() && result.frames.size() == 10 && result.objects.size() == 1 ? 0 : 1;
}
