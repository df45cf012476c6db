// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "closing/global_layout.h"
#include "closing/loop_finder.h"
#include "closing/pass_layout.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

// Standard deviation of matched objects, which a matcher does not provide. Set by hand. [m]
constexpr double kSigma = 0.3;

void CheckMatches(const std::vector<std::pair<int, int>>& matches, std::size_t locals,
                  std::size_t globals) {
  for (const auto& [i, j] : matches)
    if (i < 0 || j < 0 || i >= static_cast<int>(locals) || j >= static_cast<int>(globals))
      throw Error(ErrorKind::kUsage, "the place matcher matches objects " + std::to_string(i) +
                                         " and " + std::to_string(j) + " of " +
                                         std::to_string(locals) + " local and " +
                                         std::to_string(globals) + " global ones");
}

// An answer as it is made, neither accepted nor with a place.
bool SaysNothing(const PlaceAnswer& answer) {
  return !answer.accepted && answer.matches.empty() && answer.match_frame < 0;
}

// The last frame at or before `path_m` of path; none if the path starts later.
const FrameRecord* LastUntil(const FrameStore& frames, double path_m) {
  const auto after =
      std::upper_bound(frames.begin(), frames.end(), path_m,
                       [](double m, const FrameRecord& frame) { return m < frame.travelled; });
  return after == frames.begin() ? nullptr : &*std::prev(after);
}

class HostFinder : public LoopFinder {
 public:
  HostFinder(const LoopOptions& options, PlaceMatcher matcher)
      : options_(options), global_(options), matcher_(std::move(matcher)) {}

  std::unique_ptr<LoopFinder> Clone() const override { return std::make_unique<HostFinder>(*this); }

  std::optional<FoundLoop> Find(const FinderInput& input) override {
    const SearchWindow& window = input.window;
    const FrameStore& frames = input.state.frames;
    const double global_end_m = window.GlobalMapEnd(options_.layout.gap_m);
    const PassLayout local =
        PassLayouts(input.passes, input.state)
            .Recent(window.end_m - window.local_m, options_.layout.min_sightings);
    const LayoutIndex& global = global_.Update(input.state, input.passes, global_end_m);
    const FrameRecord* old = LastUntil(frames, global_end_m);
    if (old == nullptr) return std::nullopt;
    const auto answer =
        matcher_({local.objects, global.objects(), frames.back().frame, old->frame});
    if (!answer || SaysNothing(*answer)) return std::nullopt;
    FoundLoop found;
    if (answer->matches.empty()) {
      // Images only give the pose of the newest camera, which was queried before.
      if (window.lag_m < options_.lag_m) return std::nullopt;
      found.loop = MeasureImages(input.state, *answer, old->frame);
    } else {
      CheckMatches(answer->matches, local.objects.size(), global.objects().size());
      const CommonObjects common{local, OldLandmarks(answer->matches, global), kSigma,
                                 global_end_m};
      LoopMeter meter(common, input.state, input.passes, options_, input.odometry);
      auto loop = meter.Measure(window.end_m - window.lag_m, window.beyond_m);
      if (!loop) return std::nullopt;
      found.loop = std::move(*loop);
      found.sigma_m = kSigma;
    }
    LoopClosure& row = found.loop.row;
    row.score = answer->score;
    row.decision = answer->accepted ? LoopDecision::kAccepted : LoopDecision::kAmbiguous;
    row.reason = answer->accepted ? "the matcher is sure" : "the matcher is not sure";
    return found;
  }

  bool SupportsSecondSearch() const override { return false; }

 private:
  // Two images give the relative pose of the newest camera and an old one.
  LoopMeasurement MeasureImages(const MapState& state, const PlaceAnswer& answer,
                                int old_frame) const {
    const FrameStore& frames = state.frames;
    const auto match = std::find_if(frames.begin(), frames.end(), [&](const FrameRecord& frame) {
      return frame.frame == answer.match_frame;
    });
    if (match == frames.end() || answer.match_frame > old_frame)
      throw Error(ErrorKind::kUsage,
                  "the place matcher answers with frame " + std::to_string(answer.match_frame) +
                      ", which is none of the old ones; name one up to PlaceQuery::old_frame");
    LoopMeasurement loop;
    loop.query = frames.size() - 1;
    loop.match = static_cast<int>(match - frames.begin());
    LoopClosure& row = loop.row;
    row.query_frame = frames.back().frame;
    row.match_frame = answer.match_frame;
    row.T_match_query = answer.T_match_query;
    Vec6 sigmas;
    sigmas << Vec3::Constant(options_.sigma_m), Vec3::Constant(options_.sigma_rad);
    row.covariance = Eigen::Matrix<double, 6, 6>(sigmas.cwiseAbs2().asDiagonal());
    row.viewpoint_change_rad = ViewpointChange(
        match->T_world_cam, match->T_world_cam * answer.T_match_query, state.gravity());
    return loop;
  }

  LoopOptions options_;
  GlobalLayout global_;
  PlaceMatcher matcher_;
};

}  // namespace

std::unique_ptr<LoopFinder> MakeHostFinder(const LoopOptions& options, PlaceMatcher matcher) {
  return std::make_unique<HostFinder>(options, std::move(matcher));
}

}  // namespace sslcd
