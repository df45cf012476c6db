// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/view_ties.h"

namespace sslcd {
namespace {

/// The ground that a camera sees best.
Vec3 Spot(const FrameRecord& frame, double ahead_m) { return frame.T_world_cam * Vec3(0, 0, ahead_m); }

/// The earlier camera, of another pass, that looks at nearly the same spot as frame `i`; -1: none.
int SameSpot(const std::vector<FrameRecord>& frames, int i, const PathGraph& path, const LoopViewOptions& options) {
  const Vec3 spot = Spot(frames[i], options.ahead_m);
  const PathGraph::Distances drift = path.From(frames[i].travelled);
  double nearest = options.apart_m;
  int found = -1;
  for (int k = 0; k < i && frames[i].travelled - frames[k].travelled >= options.gap_m; ++k) {
    const double apart = (Spot(frames[k], options.ahead_m) - spot).norm();
    if (apart > nearest || drift.To(frames[k].travelled) > options.reach_m) continue;
    nearest = apart;
    found = k;
  }
  return found;
}

}  // namespace

std::vector<ViewTie> TieViews(const std::vector<FrameRecord>& frames, const PathGraph& path, const ViewAligner& align,
                              const LoopViewOptions& options) {
  std::vector<ViewTie> ties;
  double last_m = -options.every_m;
  for (int i = 0; i < static_cast<int>(frames.size()); ++i) {
    if (frames[i].travelled - last_m < options.every_m) continue;
    const int old = SameSpot(frames, i, path, options);
    if (old < 0) continue;
    last_m = frames[i].travelled;
    const Pose guess = frames[old].T_world_cam.inverse() * frames[i].T_world_cam;
    if (const auto aligned = align(frames[old].frame, frames[i].frame, guess)) ties.push_back({old, i, *aligned});
  }
  return ties;
}

}  // namespace sslcd
