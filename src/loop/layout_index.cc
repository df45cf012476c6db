// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/loop/layout_index.h"

#include <algorithm>
#include <cmath>

#include "loop/triangle_index.h"

namespace sslcd {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kBin = 0.25;             // of pair distances [m]
constexpr double kSurroundings = 15.;     // radius in which density and heights are judged [m]
constexpr double kBlock = 10.;            // [m]
constexpr std::size_t kMaxPairs = 50000;  // with more, triangles are faster
constexpr int kMaxLabels = 256;           // with lists of their own

// Cells of the grid, at most: enough for those that have an object, and no memory for what lies between far ones.
double MaxCells(std::size_t objects) { return 4096. + 32. * static_cast<double>(objects); }

}  // namespace

LayoutIndex::LayoutIndex(std::vector<LayoutObject> objects, double max_pair_m, double reach_m)
    : objects_(std::move(objects)), max_pair_(max_pair_m), reach_(reach_m) {
  objects_.erase(std::remove_if(objects_.begin(), objects_.end(),
                                [](const LayoutObject& object) { return !object.position.allFinite(); }),
                 objects_.end());
  CountProperties();
  BuildBlocks();
  BuildGrid();
  BuildPairs();
}

void LayoutIndex::CountProperties() {
  points_.reserve(objects_.size());
  for (const LayoutObject& object : objects_) {
    const Eigen::Vector3f p = object.position.cast<float>();
    points_.push_back({p.x(), p.y(), p.z(), object.label});
    ++label_counts_[object.label];
    if (object.symmetry == Symmetry::kFull || !std::isfinite(object.yaw)) continue;
    const int degree = static_cast<int>(std::floor((WrapAngle(object.yaw) / (2 * kPi) + 1) * 360 + 0.5)) % 360;
    ++headings_[object.symmetry == Symmetry::kPi][degree];
  }
  for (const auto& [label, count] : label_counts_) labels_.push_back(label);
}

int LayoutIndex::Block(double coordinate) {
  constexpr double kMiddle = 1 << 29;  // keeps numbers positive, so that cutting off rounds down
  return static_cast<int>(std::clamp(coordinate / kBlock + kMiddle, 2., 2 * kMiddle - 2));
}

std::vector<LayoutIndex::InBlock>::const_iterator LayoutIndex::FirstInBlock(int column, int row) const {
  if (block_start_.empty()) return std::lower_bound(blocks_.begin(), blocks_.end(), InBlock{column, row, -1});
  if (column < first_column_) return blocks_.begin();
  if (column > last_column_) return blocks_.end();
  const int in_column = std::clamp(row - first_row_, 0, block_rows_);
  return blocks_.begin() + block_start_[static_cast<std::size_t>(column - first_column_) * block_rows_ + in_column];
}

void LayoutIndex::BuildBlocks() {
  if (objects_.empty()) return;
  blocks_.reserve(objects_.size());
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    const Vec3& p = objects_[i].position;
    blocks_.push_back({Block(p.x()), Block(p.y()), static_cast<int>(i)});
  }
  std::sort(blocks_.begin(), blocks_.end());
  const auto [low, high] =
      std::minmax_element(blocks_.begin(), blocks_.end(), [](const auto& a, const auto& b) { return a.row < b.row; });
  first_column_ = blocks_.front().column;
  last_column_ = blocks_.back().column;
  first_row_ = low->row;
  block_rows_ = high->row - low->row + 1;
  const double columns = last_column_ - first_column_ + 1.;
  if (columns * block_rows_ > MaxCells(objects_.size())) return;
  block_start_.assign(static_cast<std::size_t>(columns) * block_rows_ + 1, 0);
  for (const InBlock& entry : blocks_)
    ++block_start_[static_cast<std::size_t>(entry.column - first_column_) * block_rows_ + entry.row - first_row_ + 1];
  for (std::size_t i = 1; i < block_start_.size(); ++i) block_start_[i] += block_start_[i - 1];
}

bool LayoutIndex::Known(double x, double y) const {
  if (!std::isfinite(x) || !std::isfinite(y)) return false;
  const int row = Block(y), middle = Block(x);
  for (int column = std::max(middle - 1, first_column_); column <= std::min(middle + 1, last_column_); ++column)
    if (FirstInBlock(column, row - 1) != FirstInBlock(column, row + 2)) return true;
  return false;
}

// Every object is listed in each cell that its reach touches, so a point has to look into one cell only.
void LayoutIndex::BuildGrid() {
  if (objects_.empty()) return;
  Vec2 low = objects_[0].position.head<2>(), high = low;
  for (const LayoutObject& object : objects_) {
    low = low.cwiseMin(object.position.head<2>());
    high = high.cwiseMax(object.position.head<2>());
  }
  const double max_cells = MaxCells(objects_.size());
  const Vec2 size = high - low + Vec2(2 * reach_, 2 * reach_);
  per_cell_ = 1 / std::max({reach_, std::sqrt(size.x() * size.y() / max_cells), size.maxCoeff() / max_cells});
  min_x_ = low.x() - reach_;
  min_y_ = low.y() - reach_;
  columns_ = static_cast<int>(size.x() * per_cell_) + 1;
  rows_ = static_cast<int>(size.y() * per_cell_) + 1;

  const auto for_cells = [&](const LayoutObject& object, auto&& visit) {
    const int x0 = static_cast<int>((object.position.x() - reach_ - min_x_) * per_cell_);
    const int x1 = static_cast<int>((object.position.x() + reach_ - min_x_) * per_cell_);
    const int y0 = static_cast<int>((object.position.y() - reach_ - min_y_) * per_cell_);
    const int y1 = static_cast<int>((object.position.y() + reach_ - min_y_) * per_cell_);
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

// Neighbours by a sweep along the longer side of the map.
void LayoutIndex::BuildPairs() {
  struct Sorted {
    double along, x, y, z;
    int label, object;
  };
  Eigen::AlignedBox2d box;
  for (const LayoutObject& object : objects_) box.extend(object.position.head<2>());
  const int axis = !objects_.empty() && box.sizes().y() > box.sizes().x() ? 1 : 0;
  std::vector<Sorted> sorted;
  sorted.reserve(objects_.size());
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    const Vec3& p = objects_[i].position;
    sorted.push_back({p[axis], p.x(), p.y(), p.z(), objects_[i].label, static_cast<int>(i)});
  }
  std::sort(sorted.begin(), sorted.end(), [](const Sorted& a, const Sorted& b) {
    return a.along != b.along ? a.along < b.along : a.object < b.object;
  });

  std::vector<ObjectPair> found;
  double near_count = 0, height_sum = 0, radius = max_pair_;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    for (std::size_t j = i + 1; j < sorted.size() && sorted[j].along - sorted[i].along <= radius; ++j) {
      const Sorted *a = &sorted[i], *b = &sorted[j];
      if (a->label > b->label || (a->label == b->label && a->object > b->object)) std::swap(a, b);
      const double dx = b->x - a->x, dy = b->y - a->y, dz = b->z - a->z, d2 = dx * dx + dy * dy;
      if (d2 > radius * radius || d2 < 1e-12) continue;
      const double distance = std::sqrt(d2);
      if (distance < kSurroundings) {
        ++near_count;
        height_sum += std::min(1., dz * dz);
      }
      if (radius < max_pair_) continue;
      found.push_back({a->object, b->object, static_cast<float>(distance), static_cast<float>(dx / distance),
                       static_cast<float>(dy / distance), static_cast<float>(dz)});
    }
    if (found.size() > kMaxPairs) {  // a large map: from here on, only the surroundings are looked at
      found = {};
      radius = std::min(max_pair_ * (1 - 1e-9), kSurroundings);
    }
  }
  const double n = static_cast<double>(std::max<std::size_t>(1, objects_.size()));
  density_ = (1 + 2 * near_count / n) / (kPi * kSurroundings * kSurroundings);
  height_spread_ = near_count > 0 ? std::sqrt(height_sum / near_count / 2) : 0.;
  if (radius < max_pair_)
    triangles_ = std::make_shared<TriangleIndex>(*this);
  else
    SortPairs(found);
}

int LayoutIndex::LabelRank(int label) const {
  const auto place = std::lower_bound(labels_.begin(), labels_.end(), label);
  if (place == labels_.end() || *place != label) return -1;
  return std::min(static_cast<int>(place - labels_.begin()), kMaxLabels - 1);
}

int LayoutIndex::PairSlot(int rank_a, int rank_b, double distance_m) const {
  const int bin = std::clamp(static_cast<int>(distance_m / kBin), 0, bins_ - 1);
  return (rank_b * (rank_b + 1) / 2 + rank_a) * bins_ + bin;
}

void LayoutIndex::SortPairs(const std::vector<ObjectPair>& found) {
  const int ranks = std::min(static_cast<int>(labels_.size()), kMaxLabels);
  bins_ = static_cast<int>(max_pair_ / kBin) + 2;
  pair_start_.assign(static_cast<std::size_t>(ranks * (ranks + 1) / 2) * bins_ + 1, 0);
  std::vector<int> rank, slot;
  for (const LayoutPoint& point : points_) rank.push_back(LabelRank(point.label));
  slot.reserve(found.size());
  for (const ObjectPair& pair : found) {
    slot.push_back(PairSlot(rank[pair.a], rank[pair.b], pair.distance));
    ++pair_start_[slot.back() + 1];
  }
  for (std::size_t i = 1; i < pair_start_.size(); ++i) pair_start_[i] += pair_start_[i - 1];
  pairs_.resize(found.size());
  std::vector<int> fill(pair_start_.begin(), pair_start_.end() - 1);
  for (std::size_t i = 0; i < found.size(); ++i) pairs_[fill[slot[i]]++] = found[i];
}

std::vector<ObjectPair>::const_iterator LayoutIndex::PairsBegin(int label_a, int label_b, double from_m) const {
  const int a = LabelRank(label_a), b = LabelRank(label_b);
  if (a < 0 || b < 0 || pairs_.empty()) return pairs_.end();
  return pairs_.begin() + pair_start_[PairSlot(a, b, from_m)];
}

std::vector<ObjectPair>::const_iterator LayoutIndex::PairsEnd(int label_a, int label_b, double to_m) const {
  const int a = LabelRank(label_a), b = LabelRank(label_b);
  if (a < 0 || b < 0 || pairs_.empty()) return pairs_.end();
  return pairs_.begin() + pair_start_[PairSlot(a, b, to_m) + 1];
}

}  // namespace sslcd
