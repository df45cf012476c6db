// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "closing/loop_finder.h"
#include "closing/pass_layout.h"
#include "loop/drift.h"
#include "loop/paper_match.h"

namespace sslcd {
namespace {

// The paper prints no covariance: 0.1 m and 0.1 rad, set by hand. [m^2, rad^2]
constexpr double kVariance = 0.01;

// The paper compares positions in the world, including heights.
PassLayout InWorld(PassLayout layout, const GravityFrame& gravity) {
  for (std::size_t i = 0; i < layout.objects.size(); ++i)
    layout.objects[i].position = gravity.Basis().transpose() * layout.places[i].position;
  return layout;
}

class PrintedFinder : public LoopFinder {
 public:
  explicit PrintedFinder(const LoopOptions& options) : options_(options) {}

  std::unique_ptr<LoopFinder> Clone() const override {
    return std::make_unique<PrintedFinder>(*this);
  }

  std::optional<FoundLoop> Find(const FinderInput& input) override {
    const LoopLayoutOptions& o = options_.layout;
    const FrameStore& frames = input.state.frames;
    const GravityFrame& gravity = input.state.gravity();
    const double local_from = frames.back().travelled - o.local_m;
    const PassLayout local = InWorld(
        PassLayouts(input.passes, input.state).Recent(local_from, o.min_sightings), gravity);
    const PassLayout global = InWorld(
        PassLayouts(input.passes, input.state).Before(local_from - o.gap_m, o.min_sightings),
        gravity);
    const auto matches = PaperMatch(local.objects, global.objects, options_.paper);
    if (!matches) return std::nullopt;
    FoundLoop found;
    LoopMeasurement& loop = found.loop;
    LoopClosure& row = loop.row;
    std::vector<DriftPair> pairs;
    loop.query = frames.size() - 1;
    loop.match = loop.query;
    for (const ObjectMatch& match : *matches) {
      DriftPair& pair = pairs.emplace_back();
      pair.T_world_local = ToPose(local.places[match.local], gravity);
      pair.T_world_global = ToPose(global.places[match.global], gravity);
      row.pairs.push_back({{local.objects[match.local].id}, {global.objects[match.global].id}});
      row.score += match.similarity;
      // The loop frame is the first one that saw any of the matched objects.
      for (const PassObject& pass : input.passes.passes())
        if (pass.id == row.pairs.back().second)
          loop.match = std::min(loop.match, pass.sightings.front().first);
    }
    const std::optional<Pose> T_drift = SolveDriftAsPrinted(pairs);
    if (!T_drift || loop.match == loop.query) return std::nullopt;
    const FrameRecord &query = frames[loop.query], &match = frames[loop.match];
    row.query_frame = query.frame;
    row.match_frame = match.frame;
    // Eq. 19
    row.T_match_query = match.T_world_cam.inverse() * T_drift->inverse() * query.T_world_cam;
    row.covariance = Eigen::Matrix<double, 6, 6>::Identity() * kVariance;
    row.decision = LoopDecision::kAccepted;
    row.reason = "as printed: " + std::to_string(pairs.size()) + " objects match";
    return found;
  }

 private:
  LoopOptions options_;
};

}  // namespace

std::unique_ptr<LoopFinder> MakePrintedFinder(const LoopOptions& options) {
  return std::make_unique<PrintedFinder>(options);
}

}  // namespace sslcd
