// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/core/timing.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sslcd {

void TimingTable::Append(const TimingTable& other) {
  for (const auto& [stage, samples] : other.samples_)
    samples_[stage].insert(samples_[stage].end(), samples.begin(), samples.end());
}

std::map<std::string, StageTimes> TimingTable::Summary() const {
  std::map<std::string, StageTimes> summary;
  for (const auto& [stage, unsorted] : samples_) {
    std::vector<double> samples = unsorted;
    std::sort(samples.begin(), samples.end());
    const auto percentile = [&](double p) {
      const auto rank = static_cast<std::size_t>(std::ceil(p * samples.size()));
      return samples[std::max<std::size_t>(rank, 1) - 1];
    };
    StageTimes& times = summary[stage];
    times.count = static_cast<int>(samples.size());
    times.mean = std::accumulate(samples.begin(), samples.end(), 0.) / samples.size();
    times.p50 = percentile(0.5);
    times.p95 = percentile(0.95);
    times.max = samples.back();
  }
  return summary;
}

}  // namespace sslcd
