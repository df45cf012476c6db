// SPDX-License-Identifier: BSD-3-Clause
#include "odometry/odometry_edge.h"

namespace sslcd {

OdometryEdge OdometryBetween(const FrameStore& frames, int from, int to, const OdometryModel& model,
                             const Vec3& up, double scale) {
  OdometryEdge edge;
  const bool lost = FailuresBetween(frames, from, to).lost > 0;
  edge.T_from_to = lost ? frames[from].T_world_cam.inverse() * frames[to].T_world_cam
                        : frames[from].T_odom_cam.inverse() * frames[to].T_odom_cam;
  const Vec3 up_here = frames[to].T_world_cam.so3().inverse() * up;
  edge.information =
      InformationOf(SigmasBetween(frames, from, to, model.noise), up_here, model.factors);
  if (!lost) edge.T_from_to.translation() *= scale;
  return edge;
}

}  // namespace sslcd
