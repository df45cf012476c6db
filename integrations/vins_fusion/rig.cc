// SPDX-License-Identifier: BSD-3-Clause
#include "rig.h"

#include <utility>

namespace sslcd::vins {

Vec3 UpAxis(const Rig& rig) {
  if (rig.imu) return Vec3::UnitZ();
  return rig.T_body_cam.so3() * Vec3(0, -1, 0);
}

Options MapperOptions(const Rig& rig) {
  Options options = DefaultOptions(Mode::kRobust);
  options.level.enabled = !rig.imu;
  return options;
}

MapperContext ContextOf(const Rig& rig, const LabelTable& labels) {
  MapperContext context;
  context.gravity = GravityFrame::FromUp(UpAxis(rig));
  context.labels = labels;
  context.camera = rig.camera;
  return context;
}

Frame MakeFrame(const Keyframe& keyframe, double stamp, std::vector<Detection> detections) {
  Frame frame;
  frame.index = keyframe.index;
  frame.stamp = stamp;
  frame.T_odom_cam = keyframe.T_odom_body * keyframe.T_body_cam;
  frame.detections = std::move(detections);
  return frame;
}

}  // namespace sslcd::vins
