// SPDX-License-Identifier: BSD-3-Clause
#include "association/gallery.h"

#include <algorithm>
#include <cmath>

#include "sslcd/core/pose.h"

namespace sslcd {

int Gallery::BinOf(double viewpoint_rad) const {
  if (mode_ == Mode::kMean) return 0;
  const double turns = WrapAngle(viewpoint_rad) / (2 * M_PI) + 0.5;  // (0, 1]
  return static_cast<int>(std::floor(turns * kBins)) % kBins;
}

void Gallery::Add(const std::vector<float>& vector, double viewpoint_rad) {
  if (vector.empty() || std::isnan(viewpoint_rad)) return;
  if (bins_.empty()) bins_.resize(mode_ == Mode::kMean ? 1 : kBins);
  Bin& bin = bins_[BinOf(viewpoint_rad)];
  if (bin.sum.empty()) bin.sum.assign(vector.size(), 0.f);
  if (bin.sum.size() != vector.size()) return;
  for (std::size_t i = 0; i < vector.size(); ++i) bin.sum[i] += vector[i];
  ++bin.count;
}

const Gallery::Bin* Gallery::NearestFilled(int bin) const {
  const int bins = static_cast<int>(bins_.size());
  for (int offset = 0; offset <= bins / 2; ++offset) {
    for (const int candidate : {(bin + offset) % bins, (bin + bins - offset) % bins})
      if (bins_[candidate].count > 0) return &bins_[candidate];
  }
  return nullptr;
}

std::optional<double> Gallery::Compare(const std::vector<float>& vector,
                                       double viewpoint_rad) const {
  if (vector.empty() || bins_.empty() || std::isnan(viewpoint_rad)) return std::nullopt;
  const Bin* bin = NearestFilled(BinOf(viewpoint_rad));
  if (bin == nullptr || bin->sum.size() != vector.size()) return std::nullopt;
  double dot = 0;
  for (std::size_t i = 0; i < vector.size(); ++i) dot += double(vector[i]) * bin->sum[i];
  return std::clamp(dot / bin->count, 0., 1.);
}

double Gallery::CentreOf(int bin) const {
  const auto bins = static_cast<double>(bins_.size());
  return ((bin + 0.5) / bins - 0.5) * 2 * M_PI;
}

std::vector<AppearanceView> Gallery::Views() const {
  std::vector<AppearanceView> views;
  for (std::size_t i = 0; i < bins_.size(); ++i) {
    const Bin& bin = bins_[i];
    if (bin.count == 0) continue;
    views.push_back({CentreOf(static_cast<int>(i)), bin.count, bin.sum});
    for (float& value : views.back().vector) value /= static_cast<float>(bin.count);
  }
  return views;
}

void Gallery::Merge(const Gallery& other, double turn_rad) {
  const int bins = static_cast<int>(other.bins_.size());
  for (int i = 0; i < bins; ++i) {
    const Bin& from = other.bins_[i];
    if (from.count == 0) continue;
    if (bins_.empty()) bins_.resize(mode_ == Mode::kMean ? 1 : kBins);
    Bin& to = bins_[BinOf(other.CentreOf(i) + turn_rad)];
    if (to.sum.empty()) to.sum.assign(from.sum.size(), 0.f);
    if (to.sum.size() != from.sum.size()) continue;
    for (std::size_t k = 0; k < from.sum.size(); ++k) to.sum[k] += from.sum[k];
    to.count += from.count;
  }
}

}  // namespace sslcd
