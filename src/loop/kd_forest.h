// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <flann/algorithms/dist.h>
#include <flann/algorithms/kdtree_single_index.h>

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

namespace sslcd {

/// A dynamic set of 3D points with values in FLANN k-d trees. FLANN can only rebuild a complete
/// tree. So there are several trees, each at least twice as large as the next one, and a short list
/// without a tree. A point is built into a tree O(log n) times (the logarithmic method of Bentley
/// and Saxe, 1980).
template <class Scalar, class Value>
class KdForest {
 public:
  using Point = std::array<Scalar, 3>;

  KdForest() { trees_.push_back(std::make_unique<Tree>()); }

  void Add(const Point& point, const Value& value) {
    trees_.back()->Add(point.data(), value);
    if (trees_.back()->values.size() >= kLinear) MergeTail(false);
  }

  /// Removes one point with this value at this position. False: there is none.
  bool Remove(const Point& point, const Value& value) {
    Finder finder{value};
    for (const auto& tree : trees_) {
      tree->Search(point.data(), finder);
      if (finder.row < 0) continue;
      tree->alive[finder.row] = false;
      ++tree->dead;
      std::size_t dead = 0, all = 0;
      for (const auto& other : trees_) {
        dead += other->dead;
        all += other->values.size();
      }
      if (dead > kLinear + all / 2) MergeTail(true);
      return true;
    }
    return false;
  }

  /// Calls visitor.Visit(squared distance, value, row) for points nearer than visitor.Reach2(),
  /// which may decrease during the search. The order is unspecified but deterministic. Values keep
  /// their addresses until the next addition or removal.
  template <class Visitor>
  void Search(const Point& point, Visitor& visitor) const {
    for (const auto& tree : trees_) tree->Search(point.data(), visitor);
  }

 private:
  static constexpr std::size_t kLinear =
      32;  // up to this number of points a linear search is faster
  using Index = flann::KDTreeSingleIndex<flann::L2_3D<Scalar>>;

  // Points in fixed rows; a removed one leaves an unused row.
  struct Tree {
    std::vector<Scalar> coordinates;  // x y z per row
    std::vector<Value> values;
    std::vector<bool> alive;
    std::size_t dead = 0;
    std::unique_ptr<Index> index;  // over `coordinates`; none while rows are added

    void Add(const Scalar* point, const Value& value) {
      coordinates.insert(coordinates.end(), point, point + 3);
      values.push_back(value);
      alive.push_back(true);
    }

    void BuildIndex() {
      index = std::make_unique<Index>(flann::Matrix<Scalar>(coordinates.data(), values.size(), 3));
      index->buildIndex();
    }

    template <class Visitor>
    void Search(const Scalar* point, Visitor& visitor) const {
      Results<Visitor> results(*this, visitor);
      if (index) return index->findNeighbors(results, point, flann::SearchParams());
      for (std::size_t row = 0; row < values.size(); ++row)
        results.addPoint(flann::L2_3D<Scalar>()(point, &coordinates[3 * row], 3), row);
    }
  };

  template <class Visitor>
  class Results : public flann::ResultSet<Scalar> {
   public:
    Results(const Tree& tree, Visitor& visitor) : tree_(tree), visitor_(visitor) {}
    bool full() const override { return true; }
    Scalar worstDist() const override { return visitor_.Reach2(); }
    void addPoint(Scalar squared_distance, std::size_t row) override {
      if (tree_.alive[row] && squared_distance < visitor_.Reach2())
        visitor_.Visit(squared_distance, tree_.values[row], row);
    }

   private:
    const Tree& tree_;
    Visitor& visitor_;
  };

  struct Finder {
    const Value& value;
    std::ptrdiff_t row = -1;
    Scalar Reach2() const { return row < 0 ? Scalar(1e-6) : Scalar(-1); }
    void Visit(Scalar, const Value& other, std::size_t at) {
      if (row < 0 && other == value) row = static_cast<std::ptrdiff_t>(at);
    }
  };

  // Merges the list and the preceding trees that are less than twice as large into one tree.
  void MergeTail(bool all) {
    auto merged = std::make_unique<Tree>();
    while (!trees_.empty() && (all || trees_.back()->values.size() <
                                          std::max(2 * merged->values.size(), kLinear + 1))) {
      const Tree& tree = *trees_.back();
      for (std::size_t row = 0; row < tree.values.size(); ++row)
        if (tree.alive[row]) merged->Add(&tree.coordinates[3 * row], tree.values[row]);
      trees_.pop_back();
    }
    if (!merged->values.empty()) {
      merged->BuildIndex();
      trees_.push_back(std::move(merged));
    }
    trees_.push_back(std::make_unique<Tree>());
  }

  std::vector<std::unique_ptr<Tree>> trees_;  // by decreasing size; the last one is the list
};

}  // namespace sslcd
