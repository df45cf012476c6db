// SPDX-License-Identifier: BSD-3-Clause
#include "loop/decision.h"

#include <cmath>

#include "core/math.h"
#include "core/sigmoid.h"

namespace sslcd {
namespace {

// Least log likelihood of a measured height: 2.7 standard deviations. Set by hand. [nats]
constexpr double kLeastHeight = -3;
// Least lead of a loop that joins two parts of a trajectory: a part is compared with the whole map
// hundreds of times, without odometry. Of such attempts between quarters of five drives, those at
// wrong places reach 7.3 (docs/decision.md, "Numbers"). [nats]
constexpr double kLeastLead = 12;
// Least log likelihood ratio of the looks of its objects: below it, a place that is not in the map
// but laid out alike (PoseTrackOptions::look_alike) is more probable than the risk allows. [nats]
constexpr double kLeastAppearance = -3;

std::string Nats(double value) { return std::to_string(std::lround(value)) + " nats"; }

// Log odds of one of the poses against the other ones and `rivals`.
double LogOdds(const std::vector<double>& evidence, std::size_t of, std::vector<double> rivals) {
  for (std::size_t i = 0; i < evidence.size(); ++i)
    if (i != of) rivals.push_back(evidence[i]);
  return evidence[of] - LogSumExp(rivals);
}

}  // namespace

void DescribeFields(FieldVisitor& visitor, SingleLookOptions& options) {
  visitor.Real("min_margin", options.min_margin, -100, 1000,
               "smallest log odds of the best pose against all others [nats]");
  visitor.Real("min_evidence", options.min_evidence, -1000, 1000,
               "evidence that chance reaches; a pose below it proves nothing [nats]");
  visitor.Real("mirror_gain", options.mirror_gain, 0, 1000,
               "a mirror image that fits better by this refutes the fit [nats]");
}

void DescribeFields(FieldVisitor& visitor, LoopAcceptanceOptions& options) {
  visitor.Everyday("smaller: fewer wrong loops, and fewer loops")
      .Real("max_risk", options.max_risk, 0, 1,
            "largest probability that a pose is wrong, by its odds against all others and against "
            "'nowhere', at which its loops are accepted");
  visitor.Real("max_heading_sigma_rad", options.max_heading_sigma_rad, 0, 3,
               "largest standard deviation of the heading that a loop measures");
  visitor.Real("withdraw_m", options.withdraw_m, 0, 1e9,
               "a loop is withdrawn where the refined trajectory is off by this distance");
  visitor.Real("withdraw_rad", options.withdraw_rad, 0, 4,
               "a loop is withdrawn where the refined trajectory is off by this angle");
}

LoopVerdict DecideSingleLook(const SingleLook& look, const std::function<double()>& mirror_evidence,
                             const SingleLookOptions& options) {
  const double chance = options.min_evidence, best = look.evidence.at(0);
  std::vector<double> others = {chance};
  if (std::isfinite(look.left_out)) others.push_back(look.left_out);
  LoopVerdict verdict;
  verdict.score = LogOdds(look.evidence, 0, others);
  verdict.second_score =
      look.evidence.size() > 1 ? LogOdds(look.evidence, 1, others) : chance - best;
  const std::string objects = std::to_string(look.matches) + " objects agree";
  if (best < chance) {
    verdict.reason = objects + ", which chance explains (" + Nats(best) + ")";
  } else if (verdict.score < options.min_margin) {
    verdict.decision = LoopDecision::kAmbiguous;
    verdict.reason = objects + ", but other poses fit as well (odds " + Nats(verdict.score) + ")";
  } else if (mirror_evidence() > best + options.mirror_gain) {
    verdict.reason = objects + ", but more in the mirror image";
  } else {
    verdict.decision = LoopDecision::kAccepted;
    verdict.reason = objects;
  }
  return verdict;
}

double EvidenceOnTrack(double evidence, double searched) {
  // 1.5 m about the pose and .35 rad of heading; set by hand. [m^2 rad]
  constexpr double kTrackVolume = 2.5;
  return evidence + std::log(searched / kTrackVolume);
}

TrackVerdict DecideTrack(const TrackEvidence& track, const LoopAcceptanceOptions& options) {
  TrackVerdict verdict;
  LoopVerdict& loop = verdict.loop;
  loop.score = track.margin;
  loop.second_score = track.second_margin;
  loop.decision = track.evidence < 0 ? LoopDecision::kNone : LoopDecision::kAmbiguous;
  std::string weakness;
  if (track.own_evidence < 0)
    weakness = "too few objects of its own agree";
  else if (track.height < kLeastHeight)
    weakness = "odometry is at another height";
  else if (track.heading_sigma_rad >= options.max_heading_sigma_rad)
    weakness = "heading too uncertain";
  verdict.confirmed = weakness.empty();
  std::string doubt;  // about a loop for which no odometry speaks
  if (track.joins && track.lead < kLeastLead)
    doubt = "too few objects agree where odometry says nothing";
  else if (track.joins && track.appearance < kLeastAppearance)
    doubt = "the objects look different";
  const bool sure = Sigmoid(-track.margin) <= options.max_risk;
  if (verdict.confirmed && sure && doubt.empty()) {
    loop.decision = LoopDecision::kAccepted;
    return verdict;
  }
  if (track.evidence < 0)
    loop.reason = "chance explains the best pose";
  else if (!sure)
    loop.reason = "another pose fits nearly as well";
  else
    loop.reason = doubt.empty() ? weakness : doubt;
  return verdict;
}

void ApplyGraphVerdict(bool kept, LoopClosure& loop) {
  if (kept && loop.decision != LoopDecision::kAccepted) loop.reason = "other loops agree after all";
  if (!kept) loop.reason = "contradicts other loops";
  loop.decision = kept ? LoopDecision::kAccepted : LoopDecision::kAmbiguous;
}

bool IsWithdrawn(const LoopClosure& loop, const Pose& T_match_query,
                 const LoopAcceptanceOptions& options) {
  const Pose error = loop.T_match_query.inverse() * T_match_query;
  return !(error.translation().norm() < options.withdraw_m &&
           error.so3().Log().norm() < options.withdraw_rad);
}

}  // namespace sslcd
