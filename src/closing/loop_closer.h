// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "closing/loop_ledger.h"
#include "sslcd/core/timing.h"
#include "sslcd/refine/options.h"

namespace sslcd {

/// Loop closure at keyframes (paper IV): decides when to search and passes the results of the
/// finder to the ledger and the corrector. Has no reference to the map; copyable.
class LoopCloser {
 public:
  /// `matcher` is the host's matcher; none: the finder of `options.finder`.
  LoopCloser(const LoopOptions& options, const WholeMapOptions& whole_map, Gallery::Mode galleries,
             const PlaceMatcher& matcher);
  LoopCloser(const LoopCloser& other);
  LoopCloser(LoopCloser&&) = default;

  /// Adds the newest frame. `seen` has its detections with appearance.
  void AddFrame(const MapState& state, const std::vector<Detection>& seen) {
    passes_.AddFrame(state, seen);
  }

  /// Searches for a loop if the camera has moved far enough since the last attempt, and corrects
  /// trajectory and map. `scale` is metres per odometry metre.
  void AddKeyframe(MapState& state, double scale, TimingTable& timing);

  /// Searches after the last frame: from the latest cameras, whose local maps are complete now, and
  /// then a second time along the whole run. The first loops have corrected the trajectory, so the
  /// prior is narrow and few objects suffice.
  void Finish(MapState& state, double scale, TimingTable& timing);

  /// Reviews the loops after the refinement, see ReviewLoops. True: a loop that has fused landmarks
  /// was withdrawn, so they were split, and the map needs another refinement.
  bool Review(MapState& state);

  /// Searches that found no candidate, the second search along the run left out.
  int without_candidate() const { return without_candidate_; }

  /// Factors on LoopOptions::odometry that the resightings of the run have taught so far.
  const OdometryFactors& odometry_factors() const { return odometry_factors_; }

  LoopLedger& ledger() { return ledger_; }
  const LoopLedger& ledger() const { return ledger_; }

 private:
  void SearchAndCorrect(MapState& state, const SearchWindow& window, double scale,
                        TimingTable& timing);
  void LearnOdometry(const MapState& state, double scale);
  bool Search(const MapState& state, const SearchWindow& window);
  void Correct(MapState& state, double end_m, double scale);
  void SearchAgain(MapState& state, double scale, TimingTable& timing);

  LoopOptions options_;
  WholeMapOptions whole_map_;
  PassMap passes_;
  std::unique_ptr<LoopFinder> finder_;
  LoopLedger ledger_;
  int without_candidate_ = 0;
  double last_attempt_m_ = 0;
  OdometryFactors odometry_factors_;
  double learnt_at_m_ = 0;  // path at which they were learnt
};

}  // namespace sslcd
