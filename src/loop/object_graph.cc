// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/loop/object_graph.h"

#include <flann/algorithms/dist.h>
#include <flann/algorithms/kdtree_single_index.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>
#include <unordered_map>

#include "sslcd/core/error.h"

namespace sslcd {
namespace {

using Index = flann::KDTreeSingleIndex<flann::L2_3D<double>>;

constexpr std::size_t kLinear = 32;  // so few points are searched faster without a tree

/// Some of the vertices, in rows that stay where they are; a removed vertex leaves a dead row.
struct Tree {
  std::vector<double> coordinates;  // x y z of each row
  std::vector<int> ids;
  std::vector<char> alive;
  std::size_t dead = 0;
  std::unique_ptr<Index> index;  // over `coordinates`; none while rows are still being added

  const double* Row(std::size_t row) const { return &coordinates[3 * row]; }

  void Add(int id, const double* p) {
    coordinates.insert(coordinates.end(), p, p + 3);
    ids.push_back(id);
    alive.push_back(true);
  }

  void Build() {
    index = std::make_unique<Index>(flann::Matrix<double>(coordinates.data(), ids.size(), 3));
    index->buildIndex();
  }
};

/// The k best of several trees in the order (distance, id), where FLANN's own result sets leave equal distances in the
/// order of the search.
class BestK : public flann::ResultSet<double> {
 public:
  explicit BestK(std::size_t k) : k_(k) {}

  void Search(const Tree& tree, const double* point) {
    tree_ = &tree;
    if (tree.index) return tree.index->findNeighbors(*this, point, flann::SearchParams());
    for (std::size_t row = 0; row < tree.ids.size(); ++row)
      addPoint(flann::L2_3D<double>()(point, tree.Row(row), 3), row);
  }

  bool full() const override { return best_.size() == k_; }

  // A hair above the worst, so that the search does not pass by points that are equally far.
  double worstDist() const override {
    return full() ? best_.back().distance_m * (1 + 1e-12) + 1e-300 : std::numeric_limits<double>::max();
  }

  void addPoint(double squared_distance, std::size_t row) override {
    if (!tree_->alive[row]) return;
    const GraphEdge edge{tree_->ids[row], squared_distance};
    const auto nearer = [](const GraphEdge& a, const GraphEdge& b) {
      return std::tie(a.distance_m, a.id) < std::tie(b.distance_m, b.id);
    };
    best_.insert(std::upper_bound(best_.begin(), best_.end(), edge, nearer), edge);
    if (best_.size() > k_) best_.pop_back();
  }

  std::vector<GraphEdge> Take() {
    for (GraphEdge& edge : best_) edge.distance_m = std::sqrt(edge.distance_m);
    return std::move(best_);
  }

 private:
  std::size_t k_;
  const Tree* tree_ = nullptr;
  std::vector<GraphEdge> best_;  // squared distances until taken
};

}  // namespace

/// FLANN can only rebuild a k-d tree as a whole. So there are several, each at least twice as large as the next, and
/// behind them a short list without a tree: a point is built into a tree O(log n) times (the logarithmic method of
/// Bentley and Saxe, 1980).
struct ObjectGraph::Forest {
  struct Place {
    Tree* tree;
    std::size_t row;
    const double* point() const { return tree->Row(row); }
  };
  std::vector<std::unique_ptr<Tree>> trees;  // by falling size; the last is the list
  std::unordered_map<int, Place> places;

  Forest() { trees.push_back(std::make_unique<Tree>()); }

  void Add(int id, const double* p) {
    Tree& list = *trees.back();
    places[id] = {&list, list.ids.size()};
    list.Add(id, p);
    if (list.ids.size() >= kLinear) MergeTail(false);
  }

  void Remove(const Place& place) {
    place.tree->alive[place.row] = false;
    ++place.tree->dead;
    places.erase(place.tree->ids[place.row]);
    std::size_t dead = 0;
    for (const auto& tree : trees) dead += tree->dead;
    if (dead > kLinear + places.size()) MergeTail(true);
  }

  // Turns the list, and the trees before it that are less than twice as large, into one tree.
  void MergeTail(bool all) {
    auto merged = std::make_unique<Tree>();
    while (!trees.empty() && (all || trees.back()->ids.size() < std::max(2 * merged->ids.size(), kLinear + 1))) {
      const Tree& tree = *trees.back();
      for (std::size_t row = 0; row < tree.ids.size(); ++row) {
        if (!tree.alive[row]) continue;
        places[tree.ids[row]] = {merged.get(), merged->ids.size()};
        merged->Add(tree.ids[row], tree.Row(row));
      }
      trees.pop_back();
    }
    if (!merged->ids.empty()) {
      merged->Build();
      trees.push_back(std::move(merged));
    }
    trees.push_back(std::make_unique<Tree>());
  }
};

ObjectGraph::ObjectGraph() : forest_(std::make_unique<Forest>()) {}
ObjectGraph::~ObjectGraph() = default;
ObjectGraph::ObjectGraph(ObjectGraph&&) noexcept = default;
ObjectGraph& ObjectGraph::operator=(ObjectGraph&&) noexcept = default;

void ObjectGraph::Put(int id, const Vec3& position) {
  if (!position.allFinite())
    throw Error(ErrorKind::kBadInput,
                "object " + std::to_string(id) + " cannot join the graph: its position is not finite; leave it out");
  const auto known = forest_->places.find(id);
  if (known != forest_->places.end()) {
    if (std::equal(position.data(), position.data() + 3, known->second.point())) return;
    forest_->Remove(known->second);
  }
  forest_->Add(id, position.data());
}

void ObjectGraph::Remove(int id) {
  const auto known = forest_->places.find(id);
  if (known != forest_->places.end()) forest_->Remove(known->second);
}

std::vector<GraphEdge> ObjectGraph::Neighbours(int id, int k) const {
  const auto known = forest_->places.find(id);
  if (known == forest_->places.end() || k <= 0) return {};
  const double* p = known->second.point();
  std::vector<GraphEdge> edges = Nearest(Vec3(p[0], p[1], p[2]), k + 1);
  // The vertex itself is among them, unless more than k others lie on the same spot.
  const auto self = std::find_if(edges.begin(), edges.end(), [id](const GraphEdge& edge) { return edge.id == id; });
  if (self != edges.end())
    edges.erase(self);
  else
    edges.pop_back();
  return edges;
}

std::vector<GraphEdge> ObjectGraph::Nearest(const Vec3& point, int k) const {
  if (k <= 0 || !point.allFinite()) return {};
  BestK best(k);
  for (const auto& tree : forest_->trees) best.Search(*tree, point.data());
  return best.Take();
}

bool ObjectGraph::Contains(int id) const { return forest_->places.count(id) > 0; }
int ObjectGraph::size() const { return static_cast<int>(forest_->places.size()); }

}  // namespace sslcd
