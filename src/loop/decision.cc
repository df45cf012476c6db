// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/loop/decision.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sslcd {
namespace {

// How probable all hypotheses but one are together with chance, as a log.
double Rivals(const std::vector<PoseHypothesis>& all, std::size_t except, double chance) {
  double top = chance;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (i != except) top = std::max(top, all[i].fit.evidence);
  double sum = std::exp(chance - top);
  for (std::size_t i = 0; i < all.size(); ++i)
    if (i != except) sum += std::exp(all[i].fit.evidence - top);
  return top + std::log(sum);
}

// What the mirror image of the local map reaches. Coarse poses tell nearly all of it: a few are
// refined.
double MirrorEvidence(std::vector<LayoutObject> local, const LayoutIndex& index,
                      const LayoutMatchOptions& options) {
  for (LayoutObject& object : local) {
    object.position.y() *= -1;
    object.yaw *= -1;
  }
  PoseSearchOptions search = options.search;
  search.refine = std::max(1, search.refine / 10);
  const std::vector<PoseHypothesis> found =
      SearchPoses(LayoutLikelihood(local, index, options.likelihood), search);
  return found.empty() ? -std::numeric_limits<double>::infinity() : found[0].fit.evidence;
}

std::string Nats(double value) { return std::to_string(std::lround(value)) + " nats"; }

}  // namespace

void DescribeFields(FieldVisitor& visitor, DecisionOptions& options) {
  visitor.Real("min_margin", options.min_margin, -100, 1000,
               "log odds of the best pose against all others [nats]");
  visitor.Real("min_evidence", options.min_evidence, -1000, 1000,
               "evidence that chance reaches: what is below proves nothing [nats]");
  visitor.Real("mirror_gain", options.mirror_gain, 0, 1000,
               "a mirror image that fits better by this refutes the fit");
}

void DescribeFields(FieldVisitor& visitor, LayoutMatchOptions& options) {
  visitor.Real("max_pair_m", options.max_pair_m, 1, 1000,
               "objects further apart propose no pose together");
  visitor.Real("reach_m", options.reach_m, 0.1, 20,
               "a local object is compared with what the map has within this");
  visitor.Nested("search", options.search, "which poses are tried");
  visitor.Nested("likelihood", options.likelihood, "how a pose is scored");
  visitor.Nested("decision", options.decision, "when the best pose is believed");
}

LayoutAnswer MatchLayouts(const std::vector<LayoutObject>& local, const LayoutIndex& index,
                          const LayoutMatchOptions& options) {
  LayoutAnswer answer;
  std::vector<LayoutObject> usable;
  std::vector<int> origin;
  for (std::size_t i = 0; i < local.size(); ++i) {
    if (!local[i].position.allFinite()) continue;
    usable.push_back(local[i]);
    origin.push_back(static_cast<int>(i));
  }
  const std::size_t fewest = std::min(usable.size(), index.objects().size());
  if (fewest < static_cast<std::size_t>(options.search.min_matches)) {
    answer.reason = std::to_string(fewest) +
                    " objects are too few: " + std::to_string(options.search.min_matches) +
                    " have to agree";
    return answer;
  }
  std::vector<PoseHypothesis>& found = answer.hypotheses;
  found = SearchPoses(LayoutLikelihood(usable, index, options.likelihood), options.search);
  if (found.empty()) {
    answer.reason =
        "no pose brings " + std::to_string(options.search.min_matches) + " objects together";
    return answer;
  }
  for (PoseHypothesis& hypothesis : found)
    for (auto& [i, j] : hypothesis.fit.matches) i = origin[i];
  const double chance = options.decision.min_evidence;
  const auto log_odds = [&](std::size_t i) {
    return found[i].fit.evidence - Rivals(found, i, chance);
  };
  answer.score = log_odds(0);
  answer.second_score = found.size() > 1 ? log_odds(1) : chance - found[0].fit.evidence;
  const std::string objects = std::to_string(found[0].fit.matches.size()) + " objects agree";
  if (found[0].fit.evidence < chance) {
    answer.reason = objects + ", which chance explains (" + Nats(found[0].fit.evidence) + ")";
  } else if (answer.score < options.decision.min_margin) {
    answer.decision = LoopDecision::kAmbiguous;
    answer.reason = objects + ", but other poses fit as well (odds " + Nats(answer.score) + ")";
  } else if (MirrorEvidence(usable, index, options) >
             found[0].fit.evidence + options.decision.mirror_gain) {
    answer.reason = objects + ", but more in the mirror image";
  } else {
    answer.decision = LoopDecision::kAccepted;
    answer.reason = objects;
  }
  return answer;
}

}  // namespace sslcd
