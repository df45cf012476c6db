// SPDX-License-Identifier: BSD-3-Clause
#include "change/evidence.h"

#include <algorithm>
#include <cmath>

#include "core/math.h"

namespace sslcd {
namespace {

constexpr double kVisitGap = 10;  // out of view for longer: another visit [s]; set by hand
constexpr double kMostSure = 0.98;

template <std::size_t N>
std::vector<double> Joint(const std::array<double, N>& log_likelihood,
                          const std::array<double, N>& kinds) {
  std::vector<double> joint;
  for (std::size_t i = 0; i < N; ++i) joint.push_back(std::log(kinds[i]) + log_likelihood[i]);
  return joint;
}

template <std::size_t N>
void AddShares(const std::array<double, N>& log_likelihood, const std::array<double, N>& kinds,
               double weight, std::array<double, N>& counts) {
  const std::vector<double> joint = Joint(log_likelihood, kinds);
  const double all = LogSumExp(joint);
  for (std::size_t i = 0; i < N; ++i) counts[i] += weight * std::exp(joint[i] - all);
}

}  // namespace

std::vector<Visit> VisitsOf(const Views& views, const std::string& label,
                            const DetectionRate& rate) {
  std::vector<Visit> visits;
  double last = 0;
  for (const View& view : views) {
    if (visits.empty() || view.stamp - last > kVisitGap) visits.emplace_back();
    last = view.stamp;
    Visit& visit = visits.back();
    const double p = rate.At(view, label);
    ++visit.views;
    visit.seen += view.seen ? 1 : 0;
    visit.expected += p;
    for (std::size_t i = 0; i < kEase.size(); ++i) {
      const double q = std::min(kMostSure, kEase[i] * p);
      visit.there[i] += std::log(view.seen ? q : 1 - q);
    }
    for (std::size_t i = 0; i < kFalseRates.size(); ++i) {
      const double q = std::min(kFalseRates[i], 0.5 * p);
      visit.empty[i] += std::log(view.seen ? q : 1 - q);
    }
  }
  return visits;
}

double LogThere(const std::vector<Visit>& visits, const VisitKinds& kinds) {
  double sum = 0;
  for (const Visit& visit : visits) sum += LogSumExp(Joint(visit.there, kinds.there));
  return sum;
}

double LogEmpty(const std::vector<Visit>& visits, const VisitKinds& kinds) {
  double sum = 0;
  for (const Visit& visit : visits) sum += LogSumExp(Joint(visit.empty, kinds.empty));
  return sum;
}

void Count(const Visit& visit, const VisitKinds& kinds, double there, double empty,
           VisitKinds& counts) {
  AddShares(visit.there, kinds.there, there, counts.there);
  AddShares(visit.empty, kinds.empty, empty, counts.empty);
}

}  // namespace sslcd
