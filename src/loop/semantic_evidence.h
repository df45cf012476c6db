// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "loop/layout_index.h"
#include "sslcd/core/layout.h"
#include "sslcd/loop/options.h"

namespace sslcd {

/// Evidence of label, heading and appearance for matches of a local layout in a map (paper IV-C).
/// Refers to both, which must outlive it. It has a cache, so it is not thread-safe.
class SemanticEvidence {
 public:
  SemanticEvidence(const std::vector<LayoutObject>& local, const LayoutIndex& index,
                   const LayoutLikelihoodOptions& options);

  /// Log likelihood ratio of a match against two different objects, if the pose turns the local
  /// layout by `yaw`. `local` and `global` are indices. [nats]
  double Gain(int local, int global, double yaw) const;

 private:
  void PrepareLabels(double wrong_label);
  double HeadingGain(int local, const LayoutObject& global, double yaw) const;
  double Appearance(int local, int global) const;

  const std::vector<LayoutObject>& local_;
  const LayoutIndex& index_;
  AppearanceOptions options_;
  // gain of each local object with a correct label; 0 if there is only one label
  std::vector<double> equal_label_;
  std::vector<double> other_label_;     // the same with a wrong label
  std::vector<double> chance_heading_;  // ChanceHeadings
  mutable std::map<std::pair<int, int>, double> appearance_cache_;
};

}  // namespace sslcd
