// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <set>
#include <vector>

#include "closing/loop_ledger.h"
#include "sslcd/core/timing.h"
#include "sslcd/refine/options.h"

namespace sslcd {

/// Loop closure at keyframes (paper IV): decides when to search and passes the results of the
/// finder to the ledger and the corrector. Has no reference to the map; copyable.
class LoopCloser {
 public:
  LoopCloser(const LoopOptions& options, const WholeMapOptions& whole_map, Gallery::Mode galleries,
             std::unique_ptr<LoopFinder> finder);
  LoopCloser(const LoopCloser& other);
  LoopCloser(LoopCloser&&) = default;

  /// Adds the newest frame. `seen` has its detections with appearance.
  void AddFrame(const MapState& state, const std::vector<Detection>& seen) {
    passes_.AddFrame(state, seen);
  }

  /// Searches for a loop if the camera has moved far enough since the last attempt, and corrects
  /// trajectory and map. `scale` is metres per odometry metre.
  void AddKeyframe(MapState& state, double scale, TimingTable& timing);

  /// Searches for a loop from the newest frame.
  void SearchNow(MapState& state, double scale, TimingTable& timing);

  /// Searches a second time along the whole run. The first loops have corrected the trajectory, so
  /// the prior is narrow and few objects suffice. AddKeyframe makes such searches, too, near the
  /// loops that it finds (LoopLayoutOptions::look_back).
  void SearchAgain(MapState& state, double scale, TimingTable& timing);

  /// Searches after the last frame from the latest cameras, whose local maps are complete now.
  void SearchAtEnd(MapState& state, double scale, TimingTable& timing);

  /// Reviews the loops after the refinement, see ReviewLoops. True: a loop that has fused landmarks
  /// was withdrawn, so they were split, and the map needs another refinement.
  bool Review(MapState& state);

  /// Searches that found no candidate, the second search along the run left out.
  int without_candidate() const { return without_candidate_; }

  /// Factors on LoopOptions::odometry that the resightings of the run have taught so far.
  const OdometryFactors& odometry_factors() const { return odometry_factors_; }
  /// Learns them from the objects in sight, as the first search and each one after another tenth of
  /// the path do; to be called when the odometry has been corrected.
  void LearnFromSight(const MapState& state, double scale);

  LoopLedger& ledger() { return ledger_; }
  const LoopLedger& ledger() const { return ledger_; }

 private:
  // A finder with the end of its last local map.
  struct Look {
    std::unique_ptr<LoopFinder> finder;
    double end_m = 0;
  };
  void SearchAndCorrect(MapState& state, const SearchWindow& window, double scale,
                        TimingTable& timing);
  bool PlaceJoined(MapState& state) const;
  std::vector<double> EarlyPlaces(const FrameStore& frames, const SearchWindow& window) const;
  void AddEarly(const FrameStore& frames, const SearchWindow& window,
                const std::vector<FoundLoop>& found);
  bool Search(const MapState& state, const SearchWindow& window);
  bool SearchesTwice() const;
  void LookBack(MapState& state, double scale, TimingTable& timing);
  void LookBackNear(const FrameStore& frames, double path_m);
  SearchWindow SecondWindow(int place) const;
  bool HasOldMap(int place) const;
  std::vector<Pose> EndsOfLooks(const FrameStore& frames) const;
  void MoveLooks(const std::vector<Pose>& before, const MapState& state);

  LoopOptions options_;
  WholeMapOptions whole_map_;
  PassMap passes_;
  Look first_, second_;
  LoopLedger ledger_;
  int without_candidate_ = 0;
  std::set<int> look_back_;  // places of second searches to be made, see SecondWindow
  int last_place_ = -1;      // of the last second search
  double last_attempt_m_ = 0;
  OdometryFactors odometry_factors_;
  double learnt_at_m_ = 0;  // path at which they were learnt
};

}  // namespace sslcd
