// SPDX-License-Identifier: BSD-3-Clause
#include "loop/raster_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "loop/gain_raster.h"
#include "sslcd/loop/options.h"

namespace sslcd {
namespace {

// All set by hand (docs/notes, city).
constexpr std::size_t kMostPoints = 15;  // local objects that are correlated, the rarest first
constexpr float kFarthestPoint = 40.f;   // their largest distance from the centre [m]
constexpr float kLeastGain = 0.5f;       // of the most frequent label [nats]
constexpr float kMostUnits = 240.f;      // largest sum of bytes; rounding may add to it

struct Chosen {
  std::vector<LabelGain> labels;
  std::vector<LayoutPoint> points;
  std::vector<std::size_t> label_of;  // index in `labels`
  float sum = 0, reach = 0;           // [nats], [m]
};

Chosen Choose(const std::vector<LayoutPoint>& points, const LayoutIndex& index) {
  struct Rated {
    float gain, range;
    const LayoutPoint* point;
  };
  std::vector<Rated> rated;
  for (const LayoutPoint& p : points) {
    const float range = std::hypot(p.x, p.y);
    if (index.counts().labels.count(p.label) == 0 || !(range <= kFarthestPoint)) continue;
    const float gain = MatchGain(p.label, index) - 2 * std::log(GainRaster::kSigma);
    rated.push_back({std::max(kLeastGain, gain), range, &p});
  }
  std::stable_sort(rated.begin(), rated.end(), [](const Rated& a, const Rated& b) {
    return a.gain != b.gain ? a.gain > b.gain : a.range < b.range;
  });
  if (rated.size() > kMostPoints) rated.resize(kMostPoints);
  Chosen chosen;
  for (const Rated& r : rated) {
    const auto known = std::find_if(chosen.labels.begin(), chosen.labels.end(),
                                    [&](const LabelGain& g) { return g.label == r.point->label; });
    chosen.label_of.push_back(known - chosen.labels.begin());
    if (known == chosen.labels.end()) chosen.labels.push_back({r.point->label, r.gain});
    chosen.points.push_back(*r.point);
    chosen.sum += r.gain;
    chosen.reach = std::max(chosen.reach, r.range);
  }
  return chosen;
}

/// The peaks so far, above a threshold that rises so that about the best `most` remain.
class Peaks {
 public:
  explicit Peaks(std::size_t most) : most_(most) {}

  std::uint8_t threshold() const { return threshold_; }

  void Add(std::uint8_t sum, const CoarsePose& pose) {
    sums_.push_back(sum);
    poses_.push_back(pose);
    ++by_sum_[sum];
  }

  /// Raises the threshold to the sum that at most `most` peaks exceed.
  void Raise() {
    std::size_t above = 0;
    int sum = 255;
    while (sum > threshold_ && above + by_sum_[sum] <= most_) above += by_sum_[sum--];
    threshold_ = static_cast<std::uint8_t>(sum);
    if (sums_.size() > 4 * most_) DropLow();
  }

  std::vector<CoarsePose> Take() {
    DropLow();
    return std::move(poses_);
  }

 private:
  void DropLow() {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < sums_.size(); ++i) {
      if (sums_[i] <= threshold_) continue;
      sums_[kept] = sums_[i];
      poses_[kept++] = poses_[i];
    }
    sums_.resize(kept);
    poses_.resize(kept);
  }

  std::size_t most_;
  std::uint8_t threshold_ = 0;
  std::array<std::size_t, 256> by_sum_{};
  std::vector<std::uint8_t> sums_;
  std::vector<CoarsePose> poses_;
};

struct Turned {
  float cosine = 1, sine = 0;
  RasterShifts shifts;
};

/// The local points at each heading, as shifts of rasters; computed when needed.
class TurnedPoints {
 public:
  TurnedPoints(const Chosen& chosen, const GainRaster& raster) : chosen_(chosen), raster_(raster) {}

  const Turned& At(int heading) {
    std::optional<Turned>& turned = by_heading_[heading];
    if (turned) return *turned;
    turned.emplace();
    const float yaw = pair_directions::YawOf(heading);
    const float c = turned->cosine = std::cos(yaw), s = turned->sine = std::sin(yaw);
    for (std::size_t k = 0; k < chosen_.points.size(); ++k) {
      const LayoutPoint& p = chosen_.points[k];
      raster_.Append(chosen_.label_of[k], c * p.x - s * p.y, s * p.x + c * p.y, turned->shifts);
    }
    return *turned;
  }

 private:
  const Chosen& chosen_;
  const GainRaster& raster_;
  std::array<std::optional<Turned>, pair_directions::kHeadings> by_heading_;
};

}  // namespace

float MatchGain(int label, const LayoutIndex& index) {
  const double right_label = 1 - LayoutLikelihoodOptions().wrong_label;  // the default
  const auto& labels = index.counts().labels;
  const auto known = labels.find(label);
  const double count = known == labels.end() ? 0 : known->second;
  const double all = static_cast<double>(index.objects().size() + labels.size());
  const double by_label = labels.size() > 1 ? std::log(right_label * all / (count + 1)) : 0.;
  return static_cast<float>(by_label - std::log(2 * M_PI * index.density()));
}

bool RasterPoses::HasSearched(const MapTiles& map, const CoarsePose& pose) const {
  bool has = false;
  map.VisitBox(pose.x, pose.y, pose.x, pose.y,
               [&](const MapTiles::Tile& tile) { has = searched[tile.number]; });
  return has;
}

RasterPoses SearchRasters(const std::vector<LayoutPoint>& points, const LayoutIndex& index,
                          std::size_t most) {
  const Chosen chosen = Choose(points, index);
  RasterPoses found;
  found.searched.resize(index.tiles()->tile_count());
  if (chosen.points.empty()) return found;
  const float unit = chosen.sum / kMostUnits;
  const auto local_pairs = pair_directions::BinsOf(points);
  GainRaster raster(chosen.labels, unit, chosen.reach);
  TurnedPoints turned_points(chosen, raster);
  Correlation correlation;
  Peaks peaks(most);
  const MapTiles& map = *index.tiles();
  map.VisitAll([&](const MapTiles::Tile& tile) {
    if (tile.points.empty()) return;
    const auto headings = pair_directions::FindHeadings(local_pairs, tile.pairs);
    if (headings.count == 0) return;
    found.searched[tile.number] = true;
    raster.Enter(map, tile);
    for (int i = 0; i < headings.count; ++i) {
      const Turned& turned = turned_points.At(headings.bin[i]);
      CoarsePose pose;
      pose.cosine = turned.cosine;
      pose.sine = turned.sine;
      correlation.Add(raster.FromTile(), turned.shifts, peaks.threshold());
      correlation.VisitPeaks([&](int x, int y, std::uint8_t sum) {
        const auto middle = [](double from, int cell) {
          return static_cast<float>(from + (cell + 0.5) * GainRaster::kCell);
        };
        pose.x = middle(tile.left, x);
        pose.y = middle(tile.bottom, y);
        pose.score = unit * static_cast<float>(sum);
        peaks.Add(sum, pose);
      });
    }
    peaks.Raise();
  });
  found.cut_off = unit * static_cast<float>(peaks.threshold());
  found.poses = peaks.Take();
  return found;
}

}  // namespace sslcd
