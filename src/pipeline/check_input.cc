// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/check_input.h"

#include <cmath>
#include <string>

#include "core/finite.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

constexpr double kFarthest = 1e8;  // circumference of the Earth, with room [m]

void Refuse(const std::string& reason) { throw Error(ErrorKind::kBadInput, reason); }

}  // namespace

void CheckContext(const MapperContext& context) {
  const GravityFrame& gravity = context.gravity;
  const Eigen::Matrix3d axes = gravity.Basis();
  if (!RigidFromMatrix(axes, Vec3::Zero()))
    Refuse("MapperContext::gravity is no right-handed frame; make it by GravityFrame::FromUp");
  if (!context.camera) return;
  const Camera& camera = *context.camera;
  if (!(camera.fx > 0 && camera.fy > 0) ||
      !std::isfinite(camera.fx + camera.fy + camera.cx + camera.cy) || !camera.offset.allFinite())
    Refuse("MapperContext::camera has focal lengths that are not positive, or is not finite");
}

void CheckFrame(const Frame& frame, const FrameStore& frames, bool starts_sequence) {
  const std::string name = "frame " + std::to_string(frame.index);
  if (!std::isfinite(frame.T_odom_cam.Log().sum()) || !std::isfinite(frame.stamp))
    Refuse(name + ": its pose or stamp is not finite");
  if (!IsPose(frame.T_odom_cam))
    Refuse(name + ": the rotation of its pose is none: the quaternion must have length 1");
  if (frame.T_odom_cam.translation().norm() > kFarthest)
    Refuse(name + ": its position is farther away than the Earth is round");
  if (frame.step && !IsValid(*frame.step))
    Refuse(name + ": a standard deviation of its step is negative or not finite");
  if (frames.empty()) return;
  if (frame.index <= frames.back().frame)
    Refuse(name + ": its number is not above that of the frame before, " +
           std::to_string(frames.back().frame));
  if (!starts_sequence && frame.stamp <= frames.back().input_stamp)
    Refuse(name + ": its stamp " + std::to_string(frame.stamp) +
           " s is not after the one before it; Mapper::StartSequence() begins a new sequence");
}

}  // namespace sslcd
