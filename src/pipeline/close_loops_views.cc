// SPDX-License-Identifier: BSD-3-Clause
// Loops as aligned images measure them.
#include <cmath>
#include <utility>

#include "pipeline/close_loops.h"

namespace sslcd {
namespace {

double Uncertainty(const Pose::Matrix6& covariance) {
  return covariance.topLeftCorner<3, 3>().trace();
}

}  // namespace

RelativePose LoopCloser::OdometryBetween(int from, int to, double scale) const {
  RelativePose step{frames_[from].T_odom_cam.inverse() * frames_[to].T_odom_cam};
  const Vec3 up = frames_[to].T_world_cam.so3().inverse() * map_.gravity().up;
  step.covariance = InformationOf(SigmasOf(step.T_a_b, options_.loop.odometry), up).inverse();
  step.T_a_b.translation() *= scale;
  return step;
}

// From the match camera along its pass to a tie, across, and along the other pass to the query
// camera. The loop itself if its objects know better.
void LoopCloser::MeasureByViews(const std::vector<ViewTie>& ties, double scale) {
  constexpr double kNear = 30;  // [m] of path on both passes together
  const auto path = [this](int a, int b) {
    return std::abs(frames_[a].travelled - frames_[b].travelled);
  };
  for (Attempt& attempt : attempts_) {
    if (attempt.loop.row.decision != LoopDecision::kAccepted) continue;
    const int match = attempt.loop.match, query = attempt.loop.query;
    const LoopClosure& by_objects = attempt.anew ? *attempt.anew : attempt.loop.row;
    RelativePose best{by_objects.T_match_query, by_objects.covariance};
    bool better = false;
    for (const ViewTie& tie : ties) {
      if (path(match, tie.from) + path(query, tie.to) > kNear) continue;
      const RelativePose by_views =
          Compose(Compose(OdometryBetween(match, tie.from, scale), tie.pose),
                  OdometryBetween(tie.to, query, scale));
      if (!(Uncertainty(by_views.covariance) < Uncertainty(best.covariance))) continue;
      best = by_views;
      better = true;
    }
    if (!better) continue;
    LoopClosure row = by_objects;
    row.T_match_query = best.T_a_b;
    row.covariance = best.covariance;
    row.by_views = true;
    const Pose& T_world_match = frames_[match].T_world_cam;
    row.viewpoint_change_rad = std::abs(
        WrapAngle(Meter().Heading(T_world_match * best.T_a_b) - Meter().Heading(T_world_match)));
    attempt.anew = std::move(row);
  }
}

}  // namespace sslcd
