// SPDX-License-Identifier: BSD-3-Clause
// Loops that sslcd's own matching has not found: those of the paper's, and those of a host's.
#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

#include "pipeline/close_loops.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

using Mat6 = Eigen::Matrix<double, 6, 6>;

void CheckMatches(const std::vector<std::pair<int, int>>& matches, std::size_t locals,
                  std::size_t globals) {
  for (const auto& [i, j] : matches)
    if (i < 0 || j < 0 || i >= static_cast<int>(locals) || j >= static_cast<int>(globals))
      throw Error(ErrorKind::kUsage, "the place matcher matches objects " + std::to_string(i) +
                                         " and " + std::to_string(j) + " of " +
                                         std::to_string(locals) + " local and " +
                                         std::to_string(globals) + " global ones");
}

}  // namespace

// The two-stage matching, the drift and the loop frame of mode: paper (IV-B to IV-D), which knows
// no refusal. The loop frame is the first one that saw any of the matched objects; the newest
// camera, moved by the printed T_drift, is tied to it.
bool LoopCloser::DetectAsPrinted() {
  const LoopLayoutOptions& o = options_.loop.layout;
  const double local_from = frames_.back().travelled - o.local_m;
  PassLayout local = passes_.Recent(local_from, o.min_sightings);
  PassLayout global = passes_.Before(local_from - o.gap_m, o.min_sightings);
  for (PassLayout* layout : {&local, &global})
    for (std::size_t i = 0; i < layout->objects.size(); ++i)
      layout->objects[i].position = map_.gravity().Basis().transpose() * layout->places[i].position;
  const auto matches = PaperMatch(local.objects, global.objects, options_.loop.paper);
  if (!matches) return false;
  LoopMeasurement loop;
  LoopClosure& row = loop.row;
  std::vector<DriftPair> pairs;
  loop.query = static_cast<int>(frames_.size()) - 1;
  loop.match = loop.query;
  for (const ObjectMatch& match : *matches) {
    DriftPair& pair = pairs.emplace_back();
    pair.T_world_local = ToPose(local.places[match.local], map_.gravity());
    pair.T_world_global = ToPose(global.places[match.global], map_.gravity());
    row.pairs.push_back({{local.objects[match.local].id}, {global.objects[match.global].id}});
    row.score += match.similarity;
    for (const PassObject& pass : passes_.passes())
      if (pass.id == row.pairs.back().second)
        loop.match = std::min(loop.match, pass.sightings.front().first);
  }
  const std::optional<Pose> T_drift = SolveDriftAsPrinted(pairs);
  if (!T_drift || loop.match == loop.query) return false;
  const FrameRecord &query = frames_[loop.query], &match = frames_[loop.match];
  row.query_frame = query.frame;
  row.match_frame = match.frame;
  // Eq. 19
  row.T_match_query = match.T_world_cam.inverse() * T_drift->inverse() * query.T_world_cam;
  // none is printed: tight
  row.covariance = Mat6::Identity() * 0.01;
  Believe(AddAttempt(std::move(loop)),
          "as printed: " + std::to_string(pairs.size()) + " objects match");
  return true;
}

// A matcher of the host finds the place and decides; drift, pose graph and map are ours.
bool LoopCloser::DetectWithMatcher(const Look& look) {
  // of matched objects; a matcher does not say how well they agree [m]
  constexpr double kSigma = 0.3;
  const LoopLayoutOptions& o = options_.loop.layout;
  const double old_until = look.OldUntil(o.gap_m);
  const PassLayout local = passes_.Recent(look.here_m - look.local_m, o.min_sightings);
  const LayoutIndex& global = OldMap(old_until);
  const auto old_end =
      std::upper_bound(frames_.begin(), frames_.end(), old_until,
                       [](double m, const FrameRecord& frame) { return m < frame.travelled; });
  if (old_end == frames_.begin()) return false;
  const auto answer =
      matcher_({local.objects, global.objects(), frames_.back().frame, std::prev(old_end)->frame});
  if (!answer) return false;
  std::optional<LoopMeasurement> loop;
  if (answer->matches.empty()) {
    // images tie the newest camera, and were asked not far back
    if (look.lag_m < options_.loop.lag_m) return false;
    loop = MeasureImages(answer->match_frame, std::prev(old_end)->frame, answer->T_match_query);
  } else {
    CheckMatches(answer->matches, local.objects.size(), global.objects().size());
    const CommonObjects common{local, OldLandmarks(answer->matches, global), kSigma, old_until};
    loop = Meter().Measure(common, look.here_m - look.lag_m, look.beyond_m);
  }
  if (!loop || Known(*loop)) return false;
  Attempt& attempt = AddAttempt(std::move(*loop));
  attempt.look = look;
  attempt.sigma_m = answer->matches.empty() ? 0. : kSigma;
  LoopClosure& row = attempt.loop.row;
  row.score = answer->score;
  row.decision = LoopDecision::kAmbiguous;
  row.reason = "the matcher is not sure";
  if (answer->accepted) Believe(attempt, "the matcher is sure");
  return answer->accepted;
}

// Two images tie two cameras together: the newest one and an old one.
LoopMeasurement LoopCloser::MeasureImages(int match_frame, int old_frame,
                                          const Pose& T_match_query) const {
  const auto match = std::find_if(frames_.begin(), frames_.end(), [&](const FrameRecord& frame) {
    return frame.frame == match_frame;
  });
  if (match == frames_.end() || match_frame > old_frame)
    throw Error(ErrorKind::kUsage,
                "the place matcher answers with frame " + std::to_string(match_frame) +
                    ", which is none of the old ones; name one up to PlaceQuery::old_frame");
  LoopMeasurement loop;
  loop.query = static_cast<int>(frames_.size()) - 1;
  loop.match = static_cast<int>(match - frames_.begin());
  LoopClosure& row = loop.row;
  row.query_frame = frames_.back().frame;
  row.match_frame = match_frame;
  row.T_match_query = T_match_query;
  Vec6 sigmas;
  sigmas << Vec3::Constant(options_.loop.sigma_m), Vec3::Constant(options_.loop.sigma_rad);
  row.covariance = Mat6(sigmas.cwiseAbs2().asDiagonal());
  const LoopMeter meter = Meter();
  row.viewpoint_change_rad = std::abs(WrapAngle(meter.Heading(match->T_world_cam * T_match_query) -
                                                meter.Heading(match->T_world_cam)));
  return loop;
}

}  // namespace sslcd
