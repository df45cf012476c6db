// SPDX-License-Identifier: BSD-3-Clause
#include "loop/semantic_evidence.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "loop/appearance_likelihood.h"
#include "loop/heading_density.h"

namespace sslcd {

SemanticEvidence::SemanticEvidence(const std::vector<LayoutObject>& local, const LayoutIndex& index,
                                   const LayoutLikelihoodOptions& options)
    : local_(local),
      index_(index),
      options_(options.appearance),
      chance_heading_(ChanceHeadings(local, index.counts().headings)) {
  PrepareLabels(options.wrong_label);
}

double SemanticEvidence::Gain(int i, int j, double yaw) const {
  const LayoutObject& global = index_.objects()[j];
  const double label = local_[i].label == global.label ? equal_label_[i] : other_label_[i];
  return label + HeadingGain(i, global, yaw) + Appearance(i, j);
}

void SemanticEvidence::PrepareLabels(double wrong_label) {
  std::map<int, double> share;
  for (const auto& [label, count] : index_.counts().labels) share[label] = count;
  for (const LayoutObject& object : local_) share[object.label] += 0;
  const double total = static_cast<double>(index_.objects().size() + share.size());
  const bool tells = share.size() > 1;
  // Each wrong label is equally likely. In small maps a wrong label counts as if every object had
  // one of its own, as when their options were chosen.
  const bool is_large = index_.tiles() != nullptr;
  const double confused = wrong_label / std::max(1., static_cast<double>(share.size()) - 1);
  for (const LayoutObject& object : local_) {
    const double expected = (share[object.label] + 1) / total;
    equal_label_.push_back(tells ? std::log((1 - wrong_label) / expected) : 0.);
    other_label_.push_back(tells ? std::log(is_large ? confused / expected : wrong_label) : 0.);
  }
}

// Log likelihood ratio of the headings against chance.
double SemanticEvidence::HeadingGain(int i, const LayoutObject& global, double yaw) const {
  const LayoutObject& local = local_[i];
  if (!HasHeading(local) || !HasHeading(global) || local.symmetry != global.symmetry) return 0;
  return std::log(HeadingDensity(WrapAngle(local.yaw + yaw) - global.yaw, global.symmetry)) -
         chance_heading_[i];
}

double SemanticEvidence::Appearance(int i, int j) const {
  const LayoutObject &local = local_[i], &global = index_.objects()[j];
  const bool comparable =
      std::any_of(std::begin(kCueRows), std::end(kCueRows), [&](const CueRow& row) {
        return !local.appearance[row.cue].empty() && !global.appearance[row.cue].empty();
      });
  if (!comparable) return 0;
  const auto [known, fresh] = appearance_cache_.try_emplace({i, j}, 0.);
  if (fresh) known->second = AppearanceGain(local, global, options_);
  return known->second;
}

}  // namespace sslcd
