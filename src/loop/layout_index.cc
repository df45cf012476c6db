// SPDX-License-Identifier: BSD-3-Clause
#include "loop/layout_index.h"

#include <algorithm>
#include <cmath>

#include "loop/append.h"

namespace sslcd {
namespace {

constexpr double kBlock = 10.;  // side of the cells that hold each object once [m]
// Radius of the neighbourhood for density and heights. Set by hand. [m]
constexpr double kSurroundings = 15.;
// Unit and limit of the summed squared height differences; the limit bounds slopes and outliers.
// [m^2]
constexpr double kHeightUnit = 1e-9, kMostHeight2 = 1.;
constexpr double kSamePoint2 = 1e-12;  // squared distance of equal points [m^2]
// With more pairs, triangles are faster (docs/notes, "Loop detection against the size of the map").
constexpr std::size_t kMaxPairs = 50000;
// rebuild if more than one object in this number changes
constexpr std::size_t kFewOf = 32;

bool SamePoint(const LayoutObject& a, const LayoutObject& b) {
  return a.position == b.position && a.label == b.label;
}

}  // namespace

LayoutIndex::LayoutIndex(std::vector<LayoutObject> objects, double max_pair_m, double reach_m)
    : objects_(std::move(objects)),
      max_pair_(max_pair_m),
      reach_(reach_m),
      blocks_(kBlock),
      near_(reach_m) {
  objects_.erase(
      std::remove_if(objects_.begin(), objects_.end(),
                     [](const LayoutObject& object) { return !object.position.allFinite(); }),
      objects_.end());
  Build();
}

double LayoutIndex::pose_volume() const {
  return 2 * M_PI * static_cast<double>(objects_.size()) / density_;
}

void LayoutIndex::Build() {
  blocks_ = CellLists(kBlock);
  near_ = CellLists(reach_);
  triangles_.reset();
  tiles_.reset();
  index_of_.clear();
  counts_ = {};
  neighbours_ = height_sum_ = 0;
  points_.resize(objects_.size());
  for (int i = static_cast<int>(objects_.size()) - 1; i >= 0;
       --i) {  // cells list the last object first
    counts_.Count(objects_[i], 1);
    InsertIntoCells(i);
  }
  UpdateDensity();
  std::vector<ObjectPair> pairs = FindPairs(objects_, max_pair_, kMaxPairs + 1);
  if (pairs.size() > kMaxPairs) {
    triangles_.emplace(*this);
    tiles_.emplace();
    for (const LayoutPoint& point : points_) tiles_->Add(point);
    pairs.clear();
  }
  pairs_ = PairIndex(objects_, pairs, max_pair_);
}

void LayoutIndex::Update(const std::vector<LayoutObject>& changed,
                         const std::vector<int>& removed) {
  if (index_of_.empty())
    for (std::size_t i = 0; i < objects_.size(); ++i)
      index_of_[objects_[i].id] = static_cast<int>(i);
  const auto gone = std::count_if(removed.begin(), removed.end(),
                                  [&](int id) { return index_of_.count(id) > 0; });
  const std::size_t changes = changed.size() + static_cast<std::size_t>(gone);
  // whether this ends with a rebuild, so that lists need no updates
  const bool rebuild = !triangles_ || kFewOf * changes > objects_.size();
  for (const int id : removed) Remove(id, rebuild);
  for (const LayoutObject& object : changed) {
    if (object.position.allFinite()) {
      Put(object, rebuild);
    } else {
      Remove(object.id, rebuild);
    }
  }
  if (rebuild) {
    std::stable_sort(objects_.begin(), objects_.end(),
                     [](const LayoutObject& a, const LayoutObject& b) { return a.id < b.id; });
    Build();
  } else {
    UpdateDensity();
  }
}

// The last object takes the place of the removed one.
void LayoutIndex::Remove(int id, bool rebuild) {
  const auto known = index_of_.find(id);
  if (known == index_of_.end()) return;
  const int place = known->second, last = static_cast<int>(objects_.size()) - 1;
  index_of_.erase(known);
  if (!rebuild) {
    counts_.Count(objects_[place], -1);
    RemoveFromCells(place);
  }
  if (place != last) {
    if (!rebuild) RemoveFromCells(last);
    index_of_[objects_[last].id] = place;
    objects_[place] = std::move(objects_[last]);
    if (!rebuild) InsertIntoCells(place);
  }
  objects_.pop_back();
  points_.pop_back();
}

// Adds an object or replaces the one with its id.
void LayoutIndex::Put(const LayoutObject& object, bool rebuild) {
  const auto [place, is_new] = index_of_.insert({object.id, static_cast<int>(objects_.size())});
  const int i = place->second;
  const bool moves = is_new || !SamePoint(objects_[i], object);
  if (is_new) {
    Append(objects_);
    Append(points_);
  }
  if (rebuild) {
    objects_[i] = object;
    return;
  }
  if (!is_new) {
    counts_.Count(objects_[i], -1);
    if (moves) RemoveFromCells(i);
  }
  objects_[i] = object;
  counts_.Count(object, 1);
  if (moves) InsertIntoCells(i);
}

// Adds an object to the cells.
void LayoutIndex::InsertIntoCells(int i) {
  const Vec3& p = objects_[i].position;
  points_[i] = {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()),
                objects_[i].label};
  if (tiles_) tiles_->Add(points_[i]);
  CountNeighbours(i, 1);
  blocks_.Add(blocks_.Cell(p.x()), blocks_.Cell(p.y()), i);
  for (int column = near_.Cell(p.x() - reach_); column <= near_.Cell(p.x() + reach_); ++column)
    for (int row = near_.Cell(p.y() - reach_); row <= near_.Cell(p.y() + reach_); ++row)
      near_.Add(column, row, i);
  if (triangles_) triangles_->Add(*this, i);
}

void LayoutIndex::RemoveFromCells(int i) {
  const Vec3& p = objects_[i].position;
  if (tiles_) tiles_->Remove(points_[i]);
  blocks_.Remove(blocks_.Cell(p.x()), blocks_.Cell(p.y()), i);
  for (int column = near_.Cell(p.x() - reach_); column <= near_.Cell(p.x() + reach_); ++column)
    for (int row = near_.Cell(p.y() - reach_); row <= near_.Cell(p.y() + reach_); ++row)
      near_.Remove(column, row, i);
  CountNeighbours(i, -1);
  if (triangles_) triangles_->Remove(*this, i);
}

// Updates density and height spread by an object that is not in the cells.
void LayoutIndex::CountNeighbours(int i, int by) {
  const Vec3& p = objects_[i].position;
  const int right = blocks_.Cell(p.x() + kSurroundings), top = blocks_.Cell(p.y() + kSurroundings);
  for (int column = blocks_.Cell(p.x() - kSurroundings); column <= right; ++column) {
    for (int row = blocks_.Cell(p.y() - kSurroundings); row <= top; ++row) {
      for (const int j : blocks_.At(column, row)) {
        const Vec3 step = objects_[j].position - p;
        const double d2 = step.head<2>().squaredNorm();
        if (d2 < kSamePoint2 || !(std::sqrt(d2) < kSurroundings)) continue;
        neighbours_ += by;
        height_sum_ += by * std::llround(std::min(kMostHeight2, step.z() * step.z()) / kHeightUnit);
      }
    }
  }
}

void LayoutIndex::UpdateDensity() {
  const double n = static_cast<double>(std::max<std::size_t>(1, objects_.size()));
  const double near = static_cast<double>(neighbours_),
               heights = static_cast<double>(height_sum_) * kHeightUnit;
  density_ = (1 + 2 * near / n) / (M_PI * kSurroundings * kSurroundings);
  height_spread_ = near > 0 ? std::sqrt(heights / near / 2) : 0.;
}

bool LayoutIndex::IsMapped(double x, double y, double end_m) const {
  if (!std::isfinite(x) || !std::isfinite(y)) return false;
  const int middle = blocks_.Cell(x), row = blocks_.Cell(y);
  for (const int i : {4, 1, 3, 5, 7, 0, 2, 6, 8})  // the middle first: most points end there
    for (const int j : blocks_.At(middle + i / 3 - 1, row + i % 3 - 1))
      if (objects_[j].since_m < end_m) return true;
  return false;
}

}  // namespace sslcd
