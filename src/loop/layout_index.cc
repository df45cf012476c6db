// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/loop/layout_index.h"

#include <algorithm>
#include <cmath>

namespace sslcd {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kBin = 0.25;          // of pair distances [m]
constexpr double kSurroundings = 15.;  // radius in which density and heights are judged [m]
constexpr double kMaxCells = 4e6;

}  // namespace

LayoutIndex::LayoutIndex(const std::vector<LayoutObject>& objects, double max_pair_m, double reach_m)
    : max_pair_(max_pair_m), reach_(reach_m) {
  for (const LayoutObject& object : objects)
    if (object.position.allFinite()) objects_.push_back(object);
  for (const LayoutObject& object : objects_)
    for (const double dx : {-10., 0., 10.})
      for (const double dy : {-10., 0., 10.}) known_.insert(BlockOf(object.position.x() + dx, object.position.y() + dy));
  BuildGrid();
  BuildPairs();
}

// Every object is listed in each cell that its reach touches, so a point has to look into one cell only.
void LayoutIndex::BuildGrid() {
  if (objects_.empty()) return;
  Vec2 low = objects_[0].position.head<2>(), high = low;
  for (const LayoutObject& object : objects_) {
    low = low.cwiseMin(object.position.head<2>());
    high = high.cwiseMax(object.position.head<2>());
  }
  const Vec2 size = high - low + Vec2(2 * reach_, 2 * reach_);
  cell_ = std::max(reach_, std::sqrt(size.x() * size.y() / kMaxCells));
  cell_ = std::max(cell_, size.maxCoeff() / kMaxCells);
  min_x_ = low.x() - reach_;
  min_y_ = low.y() - reach_;
  columns_ = static_cast<int>(size.x() / cell_) + 1;
  rows_ = static_cast<int>(size.y() / cell_) + 1;

  const auto for_cells = [&](const LayoutObject& object, auto&& visit) {
    const int x0 = static_cast<int>((object.position.x() - reach_ - min_x_) / cell_);
    const int x1 = static_cast<int>((object.position.x() + reach_ - min_x_) / cell_);
    const int y0 = static_cast<int>((object.position.y() - reach_ - min_y_) / cell_);
    const int y1 = static_cast<int>((object.position.y() + reach_ - min_y_) / cell_);
    for (int y = std::max(0, y0); y <= std::min(rows_ - 1, y1); ++y)
      for (int x = std::max(0, x0); x <= std::min(columns_ - 1, x1); ++x) visit(y * columns_ + x);
  };
  cell_start_.assign(static_cast<std::size_t>(rows_) * columns_ + 1, 0);
  for (const LayoutObject& object : objects_) for_cells(object, [&](int cell) { ++cell_start_[cell + 1]; });
  for (std::size_t i = 1; i < cell_start_.size(); ++i) cell_start_[i] += cell_start_[i - 1];
  cell_objects_.resize(cell_start_.back());
  std::vector<int> fill(cell_start_.begin(), cell_start_.end() - 1);
  for (std::size_t i = 0; i < objects_.size(); ++i)
    for_cells(objects_[i], [&](int cell) { cell_objects_[fill[cell]++] = static_cast<int>(i); });
}

std::int64_t LayoutIndex::BlockOf(double x, double y) {
  constexpr double kBlock = 10.;  // [m]
  return static_cast<std::int64_t>(std::floor(x / kBlock)) << 32 ^
         (static_cast<std::int64_t>(std::floor(y / kBlock)) & 0xffffffff);
}

bool LayoutIndex::Known(double x, double y) const { return known_.count(BlockOf(x, y)) > 0; }

LayoutIndex::Range LayoutIndex::Near(double x, double y) const {
  const double column = (x - min_x_) / cell_, row = (y - min_y_) / cell_;
  if (!(column >= 0 && column < columns_ && row >= 0 && row < rows_)) return {};
  const int cell = static_cast<int>(row) * columns_ + static_cast<int>(column);
  return {cell_objects_.data() + cell_start_[cell], cell_objects_.data() + cell_start_[cell + 1]};
}

void LayoutIndex::BuildPairs() {
  // Neighbours by a sweep over objects sorted along x.
  std::vector<int> order(objects_.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return objects_[a].position.x() < objects_[b].position.x(); });
  std::vector<std::pair<std::pair<int, int>, ObjectPair>> found;
  double near_count = 0, height_sum = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      const LayoutObject *a = &objects_[order[i]], *b = &objects_[order[j]];
      if (b->position.x() - a->position.x() > max_pair_) break;
      int first = order[i], second = order[j];
      if (a->label > b->label || (a->label == b->label && first > second)) {
        std::swap(a, b);
        std::swap(first, second);
      }
      const Vec3 step = b->position - a->position;
      const double distance = std::hypot(step.x(), step.y());
      if (distance > max_pair_ || distance < 1e-6) continue;
      if (distance < kSurroundings) {
        ++near_count;
        height_sum += std::min(1., step.z() * step.z());
      }
      found.push_back({{a->label, b->label},
                       {first, second, static_cast<float>(distance), static_cast<float>(step.x() / distance),
                        static_cast<float>(step.y() / distance), static_cast<float>(step.z())}});
    }
  }
  const double n = static_cast<double>(std::max<std::size_t>(1, objects_.size()));
  density_ = (1 + 2 * near_count / n) / (kPi * kSurroundings * kSurroundings);
  height_spread_ = near_count > 0 ? std::sqrt(height_sum / near_count / 2) : 0.;

  const int bins = static_cast<int>(max_pair_ / kBin) + 2;
  for (const auto& [labels, pair] : found) {
    PairTable& table = tables_[labels];
    if (table.start.empty()) table.start.assign(bins + 1, 0);
    ++table.start[static_cast<int>(pair.distance / kBin) + 1];
  }
  for (auto& [labels, table] : tables_) {
    for (int i = 0; i < bins; ++i) table.start[i + 1] += table.start[i];
    table.pairs.resize(table.start.back());
  }
  std::map<std::pair<int, int>, std::vector<int>> fill;
  for (const auto& [labels, table] : tables_) fill[labels] = table.start;
  for (const auto& [labels, pair] : found)
    tables_[labels].pairs[fill[labels][static_cast<int>(pair.distance / kBin)]++] = pair;
}

std::vector<ObjectPair>::const_iterator LayoutIndex::PairsBegin(int label_a, int label_b, double from_m) const {
  const auto table = tables_.find({label_a, label_b});
  if (table == tables_.end()) return none_.pairs.end();
  const int bin = std::clamp(static_cast<int>(from_m / kBin), 0, static_cast<int>(table->second.start.size()) - 1);
  return table->second.pairs.begin() + table->second.start[bin];
}

std::vector<ObjectPair>::const_iterator LayoutIndex::PairsEnd(int label_a, int label_b, double to_m) const {
  const auto table = tables_.find({label_a, label_b});
  if (table == tables_.end()) return none_.pairs.end();
  const int bin = std::clamp(static_cast<int>(to_m / kBin) + 1, 0, static_cast<int>(table->second.start.size()) - 1);
  return table->second.pairs.begin() + table->second.start[bin];
}

}  // namespace sslcd
