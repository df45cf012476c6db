// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/loop/layout_likelihood.h"

#include <algorithm>
#include <cmath>

namespace sslcd {
namespace {

constexpr double kPi = 3.14159265358979323846;
// Scatter between the two maps' idea of one object. Which it is, the data say: [m].
constexpr double kSigmas[] = {0.15, 0.3, 0.5, 0.8};
constexpr double kGate = 3.;  // matched within so many standard deviations

double HeightSigma(double sigma) { return 0.06 + 0.4 * sigma; }

std::vector<Vec2> ConvexHull(std::vector<Vec2> points) {
  std::sort(points.begin(), points.end(),
            [](const Vec2& a, const Vec2& b) { return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y(); });
  const auto cross = [](const Vec2& o, const Vec2& a, const Vec2& b) {
    return (a.x() - o.x()) * (b.y() - o.y()) - (a.y() - o.y()) * (b.x() - o.x());
  };
  std::vector<Vec2> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t start = hull.size();
    for (const Vec2& p : points) {
      while (hull.size() >= start + 2 && cross(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

bool Inside(const std::vector<Vec2>& hull, double x, double y) {
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vec2 &a = hull[i], &b = hull[(i + 1) % hull.size()];
    if ((b.x() - a.x()) * (y - a.y()) - (b.y() - a.y()) * (x - a.x()) < 0) return false;
  }
  return true;
}

// Probability of one sequence of `yes` and `no` outcomes whose rate is unknown: log of the Beta-binomial.
double LogBetaBinomial(double yes, double no, double prior_yes, double prior_no) {
  const auto log_beta = [](double a, double b) { return std::lgamma(a) + std::lgamma(b) - std::lgamma(a + b); };
  return log_beta(yes + prior_yes, no + prior_no) - log_beta(prior_yes, prior_no);
}

}  // namespace

void DescribeFields(FieldVisitor& visitor, LayoutLikelihoodOptions& options) {
  visitor.Real("wrong_label", options.wrong_label, 1e-6, 0.9, "how often the detector takes one class for another");
  visitor.Real("mapped_prior", options.mapped_prior, 0.1, 1000,
               "Beta prior of the share of local objects in the map: yes");
  visitor.Real("unmapped_prior", options.unmapped_prior, 0.1, 1000,
               "Beta prior of the share of local objects in the map: no");
  visitor.Real("min_gain", options.min_gain, -100, 100, "a match that says less is none [nats]");
  visitor.Real("seen_prior", options.seen_prior, 0.1, 1000,
               "Beta prior of the share of mapped objects seen again: yes");
  visitor.Real("unseen_prior", options.unseen_prior, 0.1, 1000,
               "Beta prior of the share of mapped objects seen again: no");
}

Vec3 Apply(const YawShift& pose, const Vec3& p) {
  const double c = std::cos(pose.yaw), s = std::sin(pose.yaw);
  return {c * p.x() - s * p.y() + pose.t.x(), s * p.x() + c * p.y() + pose.t.y(), p.z() + pose.t.z()};
}

YawShift AlignPoints(const std::vector<Vec3>& from, const std::vector<Vec3>& to) {
  Vec3 mean_from = Vec3::Zero(), mean_to = Vec3::Zero();
  for (std::size_t i = 0; i < from.size(); ++i) {
    mean_from += from[i] / static_cast<double>(from.size());
    mean_to += to[i] / static_cast<double>(from.size());
  }
  double dot = 0, cross = 0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const Vec3 a = from[i] - mean_from, b = to[i] - mean_to;
    dot += a.x() * b.x() + a.y() * b.y();
    cross += a.x() * b.y() - a.y() * b.x();
  }
  YawShift pose;
  pose.yaw = std::atan2(cross, dot);
  pose.t = mean_to - Apply(pose, mean_from);
  return pose;
}

LayoutLikelihood::LayoutLikelihood(const std::vector<LayoutObject>& local, const LayoutIndex& index,
                                   const LayoutLikelihoodOptions& options)
    : local_(local), index_(index), options_(options) {
  int labels = 0;
  for (const LayoutObject& object : local) labels = std::max(labels, object.label + 1);
  for (const LayoutObject& object : index.objects()) labels = std::max(labels, object.label + 1);
  label_share_.assign(labels, 1.);
  double total = labels;
  for (const LayoutObject& object : index.objects()) {
    label_share_[object.label] += 1;
    total += 1;
  }
  for (double& share : label_share_) share /= total;
  std::vector<Vec2> points;
  for (const LayoutObject& object : local) {
    points.push_back(object.position.head<2>());
    hull_centre_ += points.back() / static_cast<double>(local.size());
  }
  for (const Vec2& point : points) hull_radius_ = std::max(hull_radius_, (point - hull_centre_).norm());
  hull_ = ConvexHull(points);
}

double LayoutLikelihood::LabelGain(int local_label, int global_label) const {
  if (label_share_.size() < 2) return 0;
  if (local_label == global_label) return std::log((1 - options_.wrong_label) / label_share_[local_label]);
  return std::log(options_.wrong_label);
}

std::vector<std::pair<int, int>> LayoutLikelihood::Matches(const YawShift& pose, double gate) const {
  struct Candidate {
    double gain;
    int local, global;
  };
  std::vector<Candidate> candidates;
  const double c = std::cos(pose.yaw), s = std::sin(pose.yaw);
  for (std::size_t i = 0; i < local_.size(); ++i) {
    const Vec3& p = local_[i].position;
    const double x = c * p.x() - s * p.y() + pose.t.x(), y = s * p.x() + c * p.y() + pose.t.y();
    for (const int j : index_.Near(x, y)) {
      const LayoutObject& object = index_.objects()[j];
      const double dx = object.position.x() - x, dy = object.position.y() - y;
      const double dz = object.position.z() - p.z() - pose.t.z();
      const double d2 = dx * dx + dy * dy + dz * dz;
      if (d2 > gate * gate) continue;
      candidates.push_back(
          {-4.5 * d2 / (gate * gate) + LabelGain(local_[i].label, object.label), static_cast<int>(i), j});
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.gain > b.gain; });
  std::vector<std::pair<int, int>> matches;
  for (const Candidate& candidate : candidates) {
    const bool taken = std::any_of(matches.begin(), matches.end(), [&](const auto& match) {
      return match.first == candidate.local || match.second == candidate.global;
    });
    if (!taken) matches.push_back({candidate.local, candidate.global});
  }
  std::sort(matches.begin(), matches.end());
  return matches;
}

// Mapped objects among the local ones that were not seen: log of the Beta-binomial of seen and unseen ones.
double LayoutLikelihood::Unseen(const YawShift& pose, const std::vector<std::pair<int, int>>& matches,
                                int& should_see) const {
  int seen = 0, all = 0;
  const double c = std::cos(pose.yaw), s = std::sin(pose.yaw);
  std::vector<char> matched(index_.objects().size(), 0);
  for (const auto& [local, global] : matches) matched[global] = 1;
  seen = static_cast<int>(matches.size());
  all = seen;
  for (std::size_t j = 0; j < index_.objects().size(); ++j) {
    if (matched[j]) continue;
    const Vec3& g = index_.objects()[j].position;
    const double dx = g.x() - pose.t.x(), dy = g.y() - pose.t.y();
    if (Inside(hull_, c * dx + s * dy, -s * dx + c * dy)) ++all;
  }
  should_see = all;
  return LogBetaBinomial(seen, all - seen, options_.seen_prior, options_.unseen_prior);
}

LayoutFit LayoutLikelihood::Evaluate(const YawShift& pose) const {
  LayoutFit best;
  best.score = -1e9;
  const std::vector<std::pair<int, int>> all = Matches(pose, kGate * kSigmas[3]);
  const double density = index_.density();
  for (const double sigma : kSigmas) {
    const double sigma_z = HeightSigma(sigma), background_z = std::hypot(sigma_z, index_.height_spread());
    LayoutFit fit;
    fit.sigma = sigma;
    Vec2 centre(0, 0);
    for (const auto& [i, j] : all) {
      const LayoutObject& object = index_.objects()[j];
      const Vec3 d = object.position - Apply(pose, local_[i].position);
      const double d2 = d.head<2>().squaredNorm() / (sigma * sigma), z2 = d.z() * d.z();
      if (d2 > kGate * kGate) continue;
      const double gain = -d2 / 2 - std::log(2 * kPi * sigma * sigma * density) - z2 / (2 * sigma_z * sigma_z) -
                          std::log(sigma_z) + z2 / (2 * background_z * background_z) + std::log(background_z) +
                          LabelGain(local_[i].label, object.label);
      if (gain < options_.min_gain) continue;
      fit.score += gain;
      fit.matches.push_back({i, j});
      centre += object.position.head<2>();
    }
    const double n = static_cast<double>(fit.matches.size());
    fit.score +=
        LogBetaBinomial(n, static_cast<double>(local_.size()) - n, options_.mapped_prior, options_.unmapped_prior);
    fit.score += Unseen(pose, fit.matches, fit.should_see);
    fit.score -= std::log(4.);
    double spread = 1e-3;
    for (const auto& [i, j] : fit.matches)
      spread += (index_.objects()[j].position.head<2>() - centre / n).squaredNorm();
    const double volume = std::pow(2 * kPi, 1.5) * sigma * sigma / std::max(1., n) * sigma / std::sqrt(spread);
    const double searched = 2 * kPi * static_cast<double>(index_.objects().size()) / density;
    fit.evidence = fit.score + std::log(volume / searched);
    if (fit.score > best.score) best = fit;
  }
  return best;
}

LayoutFit LayoutLikelihood::Refine(YawShift& pose, int rounds) const {
  double gate = index_.reach();
  for (int round = 0; round < rounds; ++round) {
    const std::vector<std::pair<int, int>> matches = Matches(pose, gate);
    if (matches.size() < 2) break;
    std::vector<Vec3> from, to;
    for (const auto& [i, j] : matches) {
      from.push_back(local_[i].position);
      to.push_back(index_.objects()[j].position);
    }
    pose = AlignPoints(from, to);
    gate = std::max(1., 0.85 * gate);
  }
  LayoutFit fit = Evaluate(pose);
  for (int round = 0; round < 2 && fit.matches.size() >= 2; ++round) {
    std::vector<Vec3> from, to;
    for (const auto& [i, j] : fit.matches) {
      from.push_back(local_[i].position);
      to.push_back(index_.objects()[j].position);
    }
    const YawShift moved = AlignPoints(from, to);
    const LayoutFit better = Evaluate(moved);
    if (better.score <= fit.score) break;
    fit = better;
    pose = moved;
  }
  return fit;
}

}  // namespace sslcd
