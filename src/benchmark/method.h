// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "baselines/options.h"
#include "sslcd/closing/place_matcher.h"
#include "sslcd/pipeline/options.h"

namespace sslcd::benchmark {

/// A way to close loops, as one row of the tables.
struct Method {
  std::string key;    ///< in file names and on the command line
  std::string title;  ///< in tables
  Options options;
  /// How it finds places, anew for each run, of whose world it is given the name (Trial::World);
  /// none: sslcd's own pipeline, as the options say.
  std::function<PlaceMatcher(const std::string& world)> matcher{};
  /// it answers from files that may change: it is measured again each time
  bool from_files = false;
};

/// All methods of the comparison, sslcd first. Those with a matcher share everything else with
/// sslcd: map, measurement of the drift, pose graph, bundle adjustment.
std::vector<Method> Methods(const baselines::BaselineOptions& baselines = {});

/// Images of the sequences, as `sslcd_sim halv --render` writes them to `folder`/WORLD. Nothing but
/// the pose graph: two images tie no objects, so bundle adjustment would undo it.
Method AppearanceMethod(const std::string& folder, const baselines::AppearanceOptions& options);

/// Point matches from files, `folder`/WORLD.txt. For precision and recall only: they measure no
/// pose.
Method PointMatchMethod(const std::string& folder, const baselines::PointMatchOptions& options);

/// sslcd, and sslcd with one part switched off or as printed in the paper.
std::vector<Method> Ablations();

/// Those of `methods` with the given keys, in that order; all where none is given. Throws
/// Error(kUsage) with the list of keys.
std::vector<Method> Select(const std::vector<Method>& methods,
                           const std::vector<std::string>& keys);

}  // namespace sslcd::benchmark
