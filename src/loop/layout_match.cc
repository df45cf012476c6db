// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/loop/layout_match.h"

#include <algorithm>
#include <limits>
#include <string>

#include "loop/decision.h"
#include "loop/indexed_match.h"
#include "loop/layout_index.h"
#include "loop/layout_likelihood.h"
#include "loop/pose_search.h"

namespace sslcd {
namespace {

constexpr int kRefinedMirrorPoses = 10;  // coarse poses give most of the evidence; set by hand

// Evidence of the mirror image of the local map.
double MirrorEvidence(std::vector<LayoutObject> local, const LayoutIndex& index,
                      const LayoutMatchOptions& options) {
  for (LayoutObject& object : local) {
    object.position.y() *= -1;
    object.yaw *= -1;
  }
  PoseSearchOptions search = options.search;
  search.refine = kRefinedMirrorPoses;
  const std::vector<PoseHypothesis> found =
      SearchPoses(LayoutLikelihood(local, index, options.likelihood), search);
  return found.empty() ? -std::numeric_limits<double>::infinity() : found[0].fit.evidence;
}

// Objects with a position that is finite.
struct UsableObjects {
  std::vector<LayoutObject> objects;
  std::vector<int> origin;  // their indices in the list given

  explicit UsableObjects(const std::vector<LayoutObject>& all) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (!all[i].position.allFinite()) continue;
      objects.push_back(all[i]);
      origin.push_back(static_cast<int>(i));
    }
  }
};

}  // namespace

void DescribeFields(FieldVisitor& visitor, LayoutMatchOptions& options) {
  visitor.Real("max_pair_m", options.max_pair_m, 5, 1000,
               "objects that are farther apart do not propose a pose together");
  visitor.Real("reach_m", options.reach_m, 0.1, 20,
               "a local object is compared with the objects of the map within this distance");
  visitor.Nested("search", options.search, "which poses are tried");
  visitor.Nested("likelihood", options.likelihood, "how a pose is scored");
}

LayoutAnswer MatchLayouts(const std::vector<LayoutObject>& local, const LayoutIndex& index,
                          const LayoutMatchOptions& options, const SingleLookOptions& decision) {
  LayoutAnswer answer;
  const UsableObjects usable(local);
  const std::string needed = std::to_string(options.search.min_matches);
  const std::size_t fewest = std::min(usable.objects.size(), index.objects().size());
  if (fewest < static_cast<std::size_t>(options.search.min_matches)) {
    answer.reason = std::to_string(fewest) + " objects are too few: " + needed + " have to agree";
    return answer;
  }
  SearchedPoses searched =
      SearchAllPoses(LayoutLikelihood(usable.objects, index, options.likelihood), options.search);
  answer.looked_at = searched.looked_at;
  answer.left_out = searched.left_out;
  std::vector<PoseHypothesis>& found = answer.hypotheses;
  found = std::move(searched.found);
  if (found.empty()) {
    answer.reason = "no pose brings " + needed + " objects together";
    return answer;
  }
  SingleLook look;
  look.matches = found[0].fit.matches.size();
  look.left_out = answer.left_out;
  for (PoseHypothesis& hypothesis : found) {
    look.evidence.push_back(hypothesis.fit.evidence);
    for (auto& [i, j] : hypothesis.fit.matches) i = usable.origin[i];
  }
  static_cast<LoopVerdict&>(answer) = DecideSingleLook(
      look, [&] { return MirrorEvidence(usable.objects, index, options); }, decision);
  return answer;
}

LayoutAnswer MatchLayouts(const std::vector<LayoutObject>& local,
                          const std::vector<LayoutObject>& global,
                          const LayoutMatchOptions& options, const SingleLookOptions& decision) {
  const UsableObjects usable(global);
  LayoutAnswer answer = MatchLayouts(
      local, LayoutIndex(usable.objects, options.max_pair_m, options.reach_m), options, decision);
  for (PoseHypothesis& hypothesis : answer.hypotheses)
    for (auto& [i, j] : hypothesis.fit.matches) j = usable.origin[j];
  return answer;
}

}  // namespace sslcd
