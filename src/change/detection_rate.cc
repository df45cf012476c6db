// SPDX-License-Identifier: BSD-3-Clause
#include "change/detection_rate.h"

#include <algorithm>
#include <cmath>

namespace sslcd {
namespace {

// Set by hand: sightings in the same session that make sure of an object, without that of the view
// in question; sectors of bearing and rings of range; views that a cell needs for half a say of its
// own; limits of a rate.
constexpr int kSure = 2, kSectors = 72, kRings = 10;
constexpr double kHalf = 8, kLowest = 0.01, kHighest = 0.99;
// Visible shares: below the first, between the first and the second, ...
constexpr float kVisible[] = {0.05f, 0.25f, 0.5f, 0.75f, 0.97f};

// The whole number of a value from 0 to `most`, which values beyond are taken for, and NaN for 0.
int Step(double value, int most) {
  return value > 0 ? static_cast<int>(std::min<double>(value, most)) : 0;
}

}  // namespace

DetectionRate::DetectionRate(const std::vector<Place>& places,
                             const std::vector<std::vector<Views>>& views) {
  for (std::size_t i = 0; i < places.size(); ++i) {
    labels_.try_emplace(places[i].label, static_cast<int>(labels_.size()));
    for (const Views& session : views[i])
      for (const View& view : session)
        range_m_ = std::max(range_m_, static_cast<double>(view.range_m));
  }
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (const Views& session : views[i]) {
      const auto seen =
          std::count_if(session.begin(), session.end(), [](const View& view) { return view.seen; });
      for (const View& view : session) {
        if (seen - (view.seen ? 1 : 0) < kSure) continue;
        for (const Cell& cell : CellsOf(view, places[i].label)) {
          Count& count = counts_[cell];
          count.all += 1;
          count.seen += view.seen ? 1 : 0;
        }
      }
    }
  }
}

std::array<DetectionRate::Cell, DetectionRate::kLevels> DetectionRate::CellsOf(
    const View& view, const std::string& label) const {
  const double turns = view.bearing_rad / (2 * M_PI) + 0.5;
  const int sector = Step(turns * kSectors, kSectors);
  const int ring = Step(kRings * view.range_m / range_m_, kRings);
  const int visible =
      static_cast<int>(std::lower_bound(std::begin(kVisible), std::end(kVisible), view.visible) -
                       std::begin(kVisible));
  const auto found = labels_.find(label);
  const int number = found == labels_.end() ? -2 : found->second;
  return {{{0, -1, -1, -1, -1},
           {1, visible, -1, -1, -1},
           {2, visible, ring, -1, -1},
           {3, visible, ring, sector, -1},
           {4, visible, ring, sector, number}}};
}

double DetectionRate::At(const View& view, const std::string& label) const {
  double rate = 0.5;
  for (const Cell& cell : CellsOf(view, label)) {
    const auto found = counts_.find(cell);
    if (found == counts_.end()) break;
    rate = (found->second.seen + kHalf * rate) / (found->second.all + kHalf);
  }
  return std::clamp(rate, kLowest, kHighest);
}

}  // namespace sslcd
