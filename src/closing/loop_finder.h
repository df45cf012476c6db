// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>

#include "closing/loop_meter.h"
#include "closing/pass_map.h"
#include "closing/path_graph.h"
#include "sslcd/closing/options.h"
#include "sslcd/closing/place_matcher.h"

namespace sslcd {

/// Which stretch of the path to look at for a loop.
struct SearchWindow {
  double here_m = 0;   ///< the end of the local map on the path [m]
  double lag_m = 0;    ///< the query camera stood this far before that
  double local_m = 0;  ///< length of the local map
  /// the query camera may have stood this far before the first or after the last matched object
  double beyond_m = 0;

  /// Where the passes of the global map must have ended.
  double OldUntil(double gap_m) const { return here_m - local_m - gap_m; }
};

/// What a finder may look at. Refers to all of it.
struct FinderInput {
  const MapState& state;
  const PassMap& passes;
  const PathGraph& path;  ///< accepted loops are its shortcuts
  SearchWindow window;
};

/// A loop, measured, with the finder's decision in its row.
struct FoundLoop {
  LoopMeasurement loop;
  double sigma_m = 0;      ///< how well the matched objects agree; 0: measured without objects
  int track = -1;          ///< of the same track of poses: same number; -1: none
  bool confirmed = false;  ///< a good measurement: to be accepted as soon as its track is
};

/// Looks for the local map in the global one. What it remembers between calls is its own.
class LoopFinder {
 public:
  virtual ~LoopFinder() = default;
  virtual std::unique_ptr<LoopFinder> Clone() const = 0;

  /// None: nothing there to decide about.
  virtual std::optional<FoundLoop> Find(const FinderInput& input) = 0;

  /// The local map's coordinates have changed: new = change(old).
  virtual void MoveLocalMap(const YawShift&) {}

  /// The trajectory was refined, or the search starts again at the beginning of the run.
  virtual void Reset() {}

  /// Whether it can be asked about earlier stretches again, after the last frame.
  virtual bool CanLookBack() const { return true; }
};

/// Follows poses over consecutive attempts (loop/pose_tracks.h) and decides by DecideTrack.
std::unique_ptr<LoopFinder> MakeTrackFinder(const LoopOptions& options);

/// The two-stage matching, the drift and the loop frame as printed (paper IV-B to IV-D), which know
/// no refusal.
std::unique_ptr<LoopFinder> MakePrintedFinder(const LoopOptions& options);

/// A matcher of the host finds the place and decides; measuring is ours.
std::unique_ptr<LoopFinder> MakeHostFinder(const LoopOptions& options, PlaceMatcher matcher);

}  // namespace sslcd
