// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "closing/loop_graph.h"
#include "closing/loop_meter.h"
#include "closing/pass_map.h"
#include "sslcd/closing/options.h"
#include "sslcd/closing/place_matcher.h"

namespace sslcd {

/// The path segment of an attempt to close a loop.
struct SearchWindow {
  double end_m = 0;    ///< path length at the end of the local map [m]
  double lag_m = 0;    ///< path from the query camera to the end of the local map
  double local_m = 0;  ///< length of the local map
  /// largest path from the query camera to the first or last matched object
  double beyond_m = 0;
  bool second = false;  ///< of the second search

  /// The passes of the global map must have ended before this path length.
  double GlobalMapEnd(double gap_m) const { return end_m - local_m - gap_m; }
};

/// The input of a finder. Refers to its parts.
struct FinderInput {
  const MapState& state;
  const PassMap& passes;
  const std::vector<LoopEdge>& loops;  ///< the accepted ones
  const OdometryFactors& odometry;     ///< on LoopOptions::odometry
  SearchWindow window;
  /// path lengths at later cameras whose loops are wanted, too (FoundLoop::early)
  std::vector<double> early_m = {};
};

/// A measured loop with the finder's decision in its row.
struct FoundLoop {
  LoopMeasurement loop;
  /// standard deviation of the matched objects; 0: measured without objects
  double sigma_m = 0;
  int track = -1;          ///< number of the track of poses; -1: none
  bool confirmed = false;  ///< a good measurement, which is accepted together with its track
  /// accepted loops of later cameras, by the same place of the local map; only with an accepted one
  std::vector<FoundLoop> early = {};
};

/// Searches the local map in the global one. May keep state between calls.
class LoopFinder {
 public:
  virtual ~LoopFinder() = default;
  virtual std::unique_ptr<LoopFinder> Clone() const = 0;

  /// Searches for a loop. None: there is no candidate.
  virtual std::optional<FoundLoop> Find(const FinderInput& input) = 0;

  /// Transforms the state after a change of the local map's coordinates: new = change(old).
  virtual void MoveLocalMap(const YawShift&) {}

  /// Drops the state after a refinement of the trajectory, or before a second search from the start
  /// of the run.
  virtual void Reset() {}

  /// Whether it supports a second search of earlier path segments after the last frame.
  virtual bool SupportsSecondSearch() const { return true; }
};

/// Tracks poses over consecutive attempts (loop/pose_tracks.h) and decides by DecideTrack.
std::unique_ptr<LoopFinder> MakeTrackFinder(const LoopOptions& options);

/// The two-stage matching, the drift and the loop frame as printed (paper IV-B to IV-D). It never
/// refuses a loop.
std::unique_ptr<LoopFinder> MakePrintedFinder(const LoopOptions& options);

/// The host's matcher finds the place and decides; sslcd measures the loop.
std::unique_ptr<LoopFinder> MakeHostFinder(const LoopOptions& options, PlaceMatcher matcher);

/// The host's matcher; none: the finder of `options.finder`.
std::unique_ptr<LoopFinder> MakeFinder(const LoopOptions& options, const PlaceMatcher& matcher);

}  // namespace sslcd
