// SPDX-License-Identifier: BSD-3-Clause
#include "loop/pair_index.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

namespace sslcd {
namespace {

constexpr double kBin = 0.25;            // of distances; of speed only [m]
constexpr int kMaxLabels = 256;          // number of labels with separate lists
constexpr double kNoDirection2 = 1e-12;  // squared distance of objects at the same place [m^2]

struct Sorted {
  double along, x, y, z;
  int label, object;
};

// Sorted by position along the longer side.
std::vector<Sorted> SortAlong(const std::vector<LayoutObject>& objects) {
  Eigen::AlignedBox2d box;
  for (const LayoutObject& object : objects) box.extend(object.position.head<2>());
  const int axis = !objects.empty() && box.sizes().y() > box.sizes().x() ? 1 : 0;
  std::vector<Sorted> sorted;
  sorted.reserve(objects.size());
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const Vec3& p = objects[i].position;
    sorted.push_back({p[axis], p.x(), p.y(), p.z(), objects[i].label, static_cast<int>(i)});
  }
  std::sort(sorted.begin(), sorted.end(), [](const Sorted& a, const Sorted& b) {
    return a.along != b.along ? a.along < b.along : a.object < b.object;
  });
  return sorted;
}

}  // namespace

std::vector<ObjectPair> FindPairs(const std::vector<LayoutObject>& objects, double max_pair_m,
                                  std::size_t most) {
  const std::vector<Sorted> sorted = SortAlong(objects);
  std::vector<ObjectPair> found;
  for (std::size_t i = 0; i < sorted.size() && found.size() < most; ++i) {
    for (std::size_t j = i + 1;
         j < sorted.size() && sorted[j].along - sorted[i].along <= max_pair_m; ++j) {
      const Sorted *a = &sorted[i], *b = &sorted[j];
      if (a->label > b->label || (a->label == b->label && a->object > b->object)) std::swap(a, b);
      const double dx = b->x - a->x, dy = b->y - a->y, dz = b->z - a->z, d2 = dx * dx + dy * dy;
      if (d2 > max_pair_m * max_pair_m || d2 < kNoDirection2) continue;
      const double distance = std::sqrt(d2);
      found.push_back({a->object, b->object, static_cast<float>(distance),
                       static_cast<float>(dx / distance), static_cast<float>(dy / distance),
                       static_cast<float>(dz)});
    }
  }
  return found;
}

PairIndex::PairIndex(const std::vector<LayoutObject>& objects, const std::vector<ObjectPair>& found,
                     double max_pair_m)
    : bins_(static_cast<int>(max_pair_m / kBin) + 2), pairs_(found.size()) {
  for (const LayoutObject& object : objects) labels_.push_back(object.label);
  std::sort(labels_.begin(), labels_.end());
  labels_.erase(std::unique(labels_.begin(), labels_.end()), labels_.end());
  const int ranks = std::min(static_cast<int>(labels_.size()), kMaxLabels);
  start_.assign(static_cast<std::size_t>(ranks * (ranks + 1) / 2) * bins_ + 1, 0);
  std::vector<int> rank, slot;
  for (const LayoutObject& object : objects) rank.push_back(LabelRank(object.label));
  slot.reserve(found.size());
  for (const ObjectPair& pair : found) {
    slot.push_back(Slot(rank[pair.a], rank[pair.b], pair.distance));
    ++start_[slot.back() + 1];
  }
  for (std::size_t i = 1; i < start_.size(); ++i) start_[i] += start_[i - 1];
  std::vector<int> fill(start_.begin(), start_.end() - 1);
  for (std::size_t i = 0; i < found.size(); ++i) pairs_[fill[slot[i]]++] = found[i];
}

PairIndex::Range PairIndex::Between(int label_a, int label_b, double from_m, double to_m) const {
  const int a = LabelRank(label_a), b = LabelRank(label_b);
  if (a < 0 || b < 0 || pairs_.empty()) return {pairs_.end(), pairs_.end()};
  return {pairs_.begin() + start_[Slot(a, b, from_m)],
          pairs_.begin() + start_[Slot(a, b, to_m) + 1]};
}

int PairIndex::LabelRank(int label) const {
  const auto place = std::lower_bound(labels_.begin(), labels_.end(), label);
  if (place == labels_.end() || *place != label) return -1;
  return std::min(static_cast<int>(place - labels_.begin()), kMaxLabels - 1);
}

int PairIndex::Slot(int rank_a, int rank_b, double distance_m) const {
  const int bin = std::clamp(static_cast<int>(distance_m / kBin), 0, bins_ - 1);
  return (rank_b * (rank_b + 1) / 2 + rank_a) * bins_ + bin;
}

}  // namespace sslcd
