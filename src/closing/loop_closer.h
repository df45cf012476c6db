// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "closing/loop_ledger.h"
#include "sslcd/core/timing.h"
#include "sslcd/refine/options.h"

namespace sslcd {

/// Loop closure as it runs with the keyframes (paper IV): decides when to look, and hands what the
/// finder finds to the ledger and the corrector. Holds no reference to the map; copyable.
class LoopCloser {
 public:
  /// `matcher`: a host's; none: the finder that `options.finder` names.
  LoopCloser(const LoopOptions& options, const WholeMapOptions& whole_map, Gallery::Mode galleries,
             const PlaceMatcher& matcher);
  LoopCloser(const LoopCloser& other);
  LoopCloser(LoopCloser&&) = default;

  /// Takes in the newest frame; `seen`: its detections with their appearance.
  void AddFrame(const MapState& state, const std::vector<Detection>& seen) {
    passes_.AddFrame(state, seen);
  }

  /// Looks for a loop if the camera has come far enough since the last time, and corrects
  /// trajectory and map by it. `scale`: metres per odometry metre.
  void AddKeyframe(MapState& state, double scale, TimingTable& timing);

  /// After the last frame: looks from the latest cameras, which nothing more will surround with
  /// objects, and then a second time along the whole run, now that the first loops have made the
  /// trajectory right: there the prior is narrow and few objects suffice.
  void Finish(MapState& state, double scale, TimingTable& timing);

  /// After everything was refined and associated again: see ReviewLoops.
  void Review(const MapState& state);

  LoopLedger& ledger() { return ledger_; }
  const LoopLedger& ledger() const { return ledger_; }

 private:
  void SearchAndCorrect(MapState& state, const SearchWindow& window, double scale,
                        TimingTable& timing);
  bool Search(const MapState& state, const SearchWindow& window);
  void Correct(MapState& state, double here_m, double scale);
  void SearchAgain(MapState& state, double scale, TimingTable& timing);

  LoopOptions options_;
  WholeMapOptions whole_map_;
  PassMap passes_;
  std::unique_ptr<LoopFinder> finder_;
  LoopLedger ledger_;
  double last_attempt_m_ = 0;
};

}  // namespace sslcd
