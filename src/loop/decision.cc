// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/loop/decision.h"

#include <algorithm>
#include <cmath>

namespace sslcd {
namespace {

double LogSumExp(const std::vector<PoseHypothesis>& all, std::size_t except) {
  double top = -1e9, sum = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (i != except) top = std::max(top, all[i].fit.evidence);
  for (std::size_t i = 0; i < all.size(); ++i)
    if (i != except) sum += std::exp(all[i].fit.evidence - top);
  return sum > 0 ? top + std::log(sum) : top;
}

}  // namespace

void DescribeFields(FieldVisitor& visitor, DecisionOptions& options) {
  visitor.Real("min_margin", options.min_margin, -100, 1000, "log odds of the best pose against all others [nats]");
  visitor.Real("min_evidence", options.min_evidence, -1000, 1000, "below this chance explains the best pose [nats]");
}

void DescribeFields(FieldVisitor& visitor, LayoutMatchOptions& options) {
  visitor.Real("max_pair_m", options.max_pair_m, 1, 1000, "objects further apart propose no pose together");
  visitor.Real("reach_m", options.reach_m, 0.1, 20, "a local object is compared with what the map has within this");
  visitor.Nested("search", options.search, "which poses are tried");
  visitor.Nested("likelihood", options.likelihood, "how a pose is scored");
  visitor.Nested("decision", options.decision, "when the best pose is believed");
}

LayoutAnswer MatchLayouts(const std::vector<LayoutObject>& local, const LayoutIndex& index,
                          const LayoutMatchOptions& options) {
  LayoutAnswer answer;
  std::vector<LayoutObject> usable;
  for (const LayoutObject& object : local)
    if (object.position.allFinite()) usable.push_back(object);
  answer.hypotheses = SearchPoses(usable, index, options.search, options.likelihood);
  if (answer.hypotheses.empty()) {
    answer.reason = "no pose brings enough objects together";
    return answer;
  }
  const double none = options.decision.min_evidence;  // "it is none of them" competes too
  const auto log_odds = [&](std::size_t i) {
    const double others = LogSumExp(answer.hypotheses, i);
    return answer.hypotheses[i].fit.evidence - std::max(others, none);
  };
  answer.score = log_odds(0);
  answer.second_score = answer.hypotheses.size() > 1 ? log_odds(1) : -answer.score;
  if (answer.hypotheses[0].fit.evidence < none) {
    answer.reason = "chance explains the best pose";
  } else if (answer.score < options.decision.min_margin) {
    answer.decision = LoopDecision::kAmbiguous;
    answer.reason = "another pose fits nearly as well";
  } else {
    answer.decision = LoopDecision::kAccepted;
    answer.reason = std::to_string(answer.hypotheses[0].fit.matches.size()) + " objects agree";
  }
  return answer;
}

}  // namespace sslcd
