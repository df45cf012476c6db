// SPDX-License-Identifier: BSD-3-Clause
#include "loop/layout_likelihood.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/math.h"

namespace sslcd {
namespace {

constexpr double kGate = 3.;       // gate of hard matches in standard deviations
constexpr double kMinGain = -1.5;  // smallest evidence of a match; set by hand [nats]
// Refine() shrinks the gate by this factor per round, down to a standard deviation. Set by hand.
// [m]
constexpr double kGateShrinkage = 0.85, kLeastGateSigma = 0.33;
constexpr int kLikelihoodRounds = 2;  // rounds of matches by the likelihood
// Lower bound of the Beta prior left for the next unmapped object: the number of objects in the
// mapped area is counted at the start, and a match may lie outside of it.
constexpr double kLeastUnmapped = 0.1;
// Initial score of a pose, below all others.
constexpr double kNothing = -1e9;
constexpr double kLeastSpread = 1e-3;  // smallest variance of matches at the same place [m^2]

// Standard deviation of height for a horizontal one: heights of boxes agree better, up to a
// constant. Set by hand. [m]
double HeightSigma(double sigma) {
  constexpr double kConstant = 0.06, kShare = 0.4;
  return kConstant + kShare * sigma;
}

}  // namespace

void DescribeFields(FieldVisitor& visitor, LayoutLikelihoodOptions& options) {
  visitor.Real("wrong_label", options.wrong_label, 1e-6, 0.9,
               "share of objects whose class the detector confuses");
  visitor.Flag("leave_map", options.leave_map,
               "local objects outside of the area that the map has seen do not count as unmapped");
  visitor.Real("wrong_height", options.wrong_height, 0, 1,
               "share of objects whose height is not comparable, e.g. on slopes");
  visitor.Nested("appearance", options.appearance, "colour and embedding as evidence (paper IV-C)");
}

LayoutLikelihood::LayoutLikelihood(const std::vector<LayoutObject>& local, const LayoutIndex& index,
                                   const LayoutLikelihoodOptions& options, const MapLimits& limits)
    : local_(local),
      index_(index),
      options_(options),
      limits_(limits),
      semantics_(local, index, options),
      view_(local) {
  for (std::size_t n = 0; n <= local.size(); ++n)
    none_mapped_.push_back(
        LogBetaBinomial(0, static_cast<double>(n), options_.mapped_prior, options_.unmapped_prior));
}

std::vector<LayoutLikelihood::Candidate> LayoutLikelihood::Candidates(const YawShift& pose,
                                                                      bool with_view) const {
  std::vector<Candidate> candidates;
  candidates.reserve(2 * local_.size());
  const double c = std::cos(pose.yaw), s = std::sin(pose.yaw);
  const double reach2 = index_.reach() * index_.reach();
  for (std::size_t i = 0; i < local_.size(); ++i) {
    const Vec3& p = local_[i].position;
    const double x = c * p.x() - s * p.y() + pose.t.x(), y = s * p.x() + c * p.y() + pose.t.y();
    for (const int j : index_.FindWithinReach(x, y)) {
      const LayoutObject& object = index_.objects()[j];
      if (object.since_m >= limits_.end_m) continue;
      const double dx = object.position.x() - x, dy = object.position.y() - y;
      const double dz = object.position.z() - p.z() - pose.t.z();
      const double d2 = dx * dx + dy * dy;
      if (d2 >= reach2 || std::abs(object.altitude - local_[i].altitude) > limits_.max_rise_m)
        continue;
      const int local = static_cast<int>(i);
      const double gain = semantics_.Gain(local, j, pose.yaw);
      candidates.push_back(
          {local, j, d2, dz * dz, gain, with_view && InView(object.position, pose.t, c, s)});
    }
  }
  return candidates;
}

// Number of map objects in the area of the local ones, which should have been seen.
int LayoutLikelihood::CountInView(const YawShift& pose) const {
  const double c = std::cos(pose.yaw), s = std::sin(pose.yaw);
  const Eigen::AlignedBox2d box = view_.BoxUnder(pose);
  int count = 0;
  index_.VisitBox(box.min(), box.max(), [&](int j) {
    const LayoutObject& object = index_.objects()[j];
    if (object.since_m < limits_.end_m) count += InView(object.position, pose.t, c, s) ? 1 : 0;
  });
  return count;
}

bool LayoutLikelihood::InView(const Vec3& global, const Vec3& t, double c, double s) const {
  const double dx = global.x() - t.x(), dy = global.y() - t.y();
  return view_.Contains(c * dx + s * dy, -s * dx + c * dy);
}

// Number of local objects inside the mapped area; the map gives no evidence about the others.
int LayoutLikelihood::CountInMappedArea(const YawShift& pose) const {
  if (!options_.leave_map) return static_cast<int>(local_.size());
  const double c = std::cos(pose.yaw), s = std::sin(pose.yaw);
  return static_cast<int>(
      std::count_if(local_.begin(), local_.end(), [&](const LayoutObject& object) {
        const Vec3& p = object.position;
        return IsMapped(c * p.x() - s * p.y() + pose.t.x(), s * p.x() + c * p.y() + pose.t.y());
      }));
}

bool LayoutLikelihood::IsMapped(double x, double y) const {
  if (!std::isfinite(x) || !std::isfinite(y)) return false;
  const auto [known, is_new] = mapped_.try_emplace(index_.BlockOf(x, y), false);
  if (is_new) known->second = index_.IsMapped(x, y, limits_.end_m);
  return known->second;
}

// Candidates with sufficient gain, largest gain first. With the horizontal distance d and the
// vertical one z between the objects, the map's density rho and the share w of wrong heights:
//   gain = log(N2(d; sigma) / rho) + log(w + (1 - w) N(z; sigma_z) / N(z; background_z)) + semantic
std::vector<LayoutLikelihood::Ranked> LayoutLikelihood::RankByGain(
    const std::vector<Candidate>& candidates, double sigma) const {
  constexpr double kRoundOff = 1e-9;  // [nats]
  const double sigma_z = HeightSigma(sigma),
               background_z = std::hypot(sigma_z, index_.height_spread());
  const double constant = -std::log(2 * M_PI * sigma * sigma * index_.density());
  const double per_z2 = 0.5 / (background_z * background_z) - 0.5 / (sigma_z * sigma_z),
               wrong = options_.wrong_height;
  const double most_by_height = std::log(wrong + (1 - wrong) * background_z / sigma_z) + kRoundOff;
  std::vector<Ranked> ranked;
  ranked.reserve(candidates.size());
  for (const Candidate& candidate : candidates) {
    const double without_height = constant - 0.5 * candidate.d2 / (sigma * sigma);
    if (without_height + most_by_height + candidate.semantic_gain < kMinGain) continue;
    const double height_ratio = background_z / sigma_z * std::exp(per_z2 * candidate.z2);
    const double gain =
        without_height + std::log(wrong + (1 - wrong) * height_ratio) + candidate.semantic_gain;
    if (!(gain < kMinGain)) ranked.push_back({gain, &candidate});
  }
  std::sort(ranked.begin(), ranked.end(), [](const Ranked& a, const Ranked& b) {
    return a.gain != b.gain ? a.gain > b.gain : a.candidate < b.candidate;
  });
  return ranked;
}

// Greedy one-to-one matches in the order of evidence, as long as they increase the score: each
// match changes the evidence of the shares of mapped and of seen objects. One more match after n of
// N objects changes the Beta-binomial by log((n + a) / (N - n - 1 + b)).
LayoutFit LayoutLikelihood::Assign(const std::vector<Candidate>& candidates, int in_view,
                                   int on_map, double sigma) const {
  const double n_local = on_map;
  double all = in_view;
  double score = none_mapped_[on_map];
  if (in_view > 0) score += LogBetaBinomial(0, all, options_.seen_prior, options_.unseen_prior);
  LayoutFit fit;
  fit.sigma = sigma;
  fit.score = score;
  fit.should_see = static_cast<int>(all);
  std::vector<std::pair<int, int>>& matches = fit.matches;
  matches.reserve(std::min(candidates.size(), local_.size()));
  std::size_t that_pay = 0;
  for (const auto& [gain, candidate] : RankByGain(candidates, sigma)) {
    const int local = candidate->local, global = candidate->global;
    const bool taken = std::any_of(matches.begin(), matches.end(), [&](const auto& match) {
      return match.first == local || match.second == global;
    });
    if (taken) continue;
    const double n = static_cast<double>(matches.size());
    score += gain + std::log((n + options_.mapped_prior) /
                             std::max(kLeastUnmapped, n_local - n - 1 + options_.unmapped_prior));
    if (candidate->in_view) {
      score += std::log((n + options_.seen_prior) / (all - n - 1 + options_.unseen_prior));
    } else {
      score +=
          std::log((n + options_.seen_prior) / (all + options_.seen_prior + options_.unseen_prior));
      all += 1;
    }
    matches.push_back({local, global});
    if (score < fit.score) continue;
    fit.score = score;
    that_pay = matches.size();
    fit.should_see = static_cast<int>(all);
  }
  matches.resize(that_pay);
  std::sort(matches.begin(), matches.end());
  return fit;
}

LayoutFit LayoutLikelihood::Evaluate(const YawShift& pose) const {
  const std::vector<Candidate> candidates = Candidates(pose, true);
  const int in_view = CountInView(pose);
  const int on_map = CountInMappedArea(pose);
  const double searched = index_.pose_volume();
  LayoutFit best;
  best.score = best.evidence = kNothing;
  const double log_sigmas = std::log(static_cast<double>(std::size(kPlaceSigmas)));
  double score = kNothing, evidence = kNothing;
  for (const double sigma : kPlaceSigmas) {
    LayoutFit fit = Assign(candidates, in_view, on_map, sigma);
    Vec2 centre(0, 0);
    const double n = static_cast<double>(fit.matches.size());
    for (const auto& [i, j] : fit.matches) centre += index_.objects()[j].position.head<2>() / n;
    double spread = kLeastSpread;
    for (const auto& [i, j] : fit.matches)
      spread += (index_.objects()[j].position.head<2>() - centre).squaredNorm();
    const double volume =
        std::pow(2 * M_PI, 1.5) * sigma * sigma / std::max(1., n) * sigma / std::sqrt(spread);
    fit.evidence = fit.score + std::log(volume / searched);
    score = LogSumExp({score, fit.score - log_sigmas});
    evidence = LogSumExp({evidence, fit.evidence - log_sigmas});
    if (fit.score > best.score) best = fit;
  }
  best.score = score;
  best.evidence = evidence;
  return best;
}

YawShift LayoutLikelihood::Align(const LayoutFit& fit) const {
  std::vector<Vec3> from, to;
  for (const auto& [i, j] : fit.matches) {
    from.push_back(local_[i].position);
    to.push_back(index_.objects()[j].position);
  }
  return AlignPoints(from, to);
}

// Matches by the likelihood, started at the pose of hard matches.
LayoutLikelihood::RefinedPose LayoutLikelihood::RefineByLikelihood(const YawShift& pose) const {
  RefinedPose best{pose, Evaluate(pose)};
  for (int round = 0; round < kLikelihoodRounds && best.fit.matches.size() >= 2; ++round) {
    const YawShift moved = Align(best.fit);
    LayoutFit better = Evaluate(moved);
    if (better.score <= best.fit.score) break;
    best = {moved, std::move(better)};
  }
  return best;
}

// Hard matches with a shrinking gate, followed by matches by the likelihood.
LayoutFit LayoutLikelihood::Refine(YawShift& pose, int rounds, double least_score) const {
  std::vector<RefineKey> way;
  std::shared_ptr<const RefinedPose> end;
  double sigma = index_.reach() / kGate;
  for (int round = 0; round < rounds && end == nullptr; ++round) {
    const LayoutFit fit = Assign(Candidates(pose, false), 0, CountInMappedArea(pose), sigma);
    if (fit.score < least_score) return LayoutFit();
    if (fit.matches.size() < 2) break;
    pose = Align(fit);
    sigma = std::max(kLeastGateSigma, kGateShrinkage * sigma);
    way.push_back({double(rounds), double(round), pose.yaw, pose.t.x(), pose.t.y(), pose.t.z()});
    const auto known = refine_cache_.find(way.back());
    if (known != refine_cache_.end()) end = known->second;
  }
  if (end == nullptr) end = std::make_shared<RefinedPose>(RefineByLikelihood(pose));
  for (const RefineKey& waypoint : way) refine_cache_.insert({waypoint, end});
  pose = end->pose;
  return end->fit;
}

}  // namespace sslcd
