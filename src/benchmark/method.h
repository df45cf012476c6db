// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "baselines/options.h"
#include "sslcd/closing/place_matcher.h"
#include "sslcd/pipeline/options.h"

namespace sslcd::benchmark {

/// A loop closure method, one row of the tables.
struct Method {
  std::string key;    ///< used in file names and on the command line
  std::string title;  ///< used in tables
  Options options;
  /// Makes the matcher of one run from the name of its world (Trial::World). Empty: sslcd's own
  /// pipeline with `options`.
  std::function<PlaceMatcher(const std::string& world)> matcher{};
  /// its answers come from files that may change, so results are never reused
  bool from_files = false;
};

/// All methods of the comparison, sslcd first. Methods with a matcher share all other parts with
/// sslcd: map, measurement of the drift, pose graph, bundle adjustment.
std::vector<Method> Methods(const baselines::BaselineOptions& baselines = {});

/// Images of the sequences, as `sslcd_sim halv --render` writes them to `folder`/WORLD. Uses only
/// the pose graph: an answer from two images has no objects, so bundle adjustment would undo it.
Method AppearanceMethod(const std::string& folder, const baselines::AppearanceOptions& options);

/// Point matches from files, `folder`/WORLD.txt. For precision and recall only, since they measure
/// no pose.
Method PointMatchMethod(const std::string& folder, const baselines::PointMatchOptions& options);

/// sslcd, and variants of it with one part switched off or as printed in the paper.
std::vector<Method> Ablations();

/// Selects `methods` by key, in the order of the keys; all of them if there are no keys. Throws
/// Error(kUsage) with the list of keys.
std::vector<Method> Select(const std::vector<Method>& methods,
                           const std::vector<std::string>& keys);

}  // namespace sslcd::benchmark
