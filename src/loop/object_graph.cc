// SPDX-License-Identifier: BSD-3-Clause
#include "loop/object_graph.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>
#include <unordered_map>

#include "loop/kd_forest.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

/// The k best in the order (distance, id). FLANN's own result sets leave equal distances in the
/// order of the search.
class BestK {
 public:
  explicit BestK(std::size_t k) : k_(k) {}

  // Slightly above the worst distance, so that the search finds points of equal distance.
  double Reach2() const {
    return best_.size() == k_ ? best_.back().distance_m * (1 + 1e-12) + 1e-300
                              : std::numeric_limits<double>::max();
  }

  void Visit(double squared_distance, int id, std::size_t) {
    const GraphEdge edge{id, squared_distance};
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
  std::vector<GraphEdge> best_;  // with squared distances until the end
};

}  // namespace

struct ObjectGraph::Vertices {
  using Forest = KdForest<double, int>;
  Forest forest;
  std::unordered_map<int, Forest::Point> places;
};

ObjectGraph::ObjectGraph() : vertices_(std::make_unique<Vertices>()) {}
ObjectGraph::~ObjectGraph() = default;
ObjectGraph::ObjectGraph(ObjectGraph&&) noexcept = default;
ObjectGraph& ObjectGraph::operator=(ObjectGraph&&) noexcept = default;

void ObjectGraph::Put(int id, const Vec3& position) {
  if (!position.allFinite())
    throw Error(ErrorKind::kBadInput,
                "object " + std::to_string(id) +
                    " cannot join the graph: its position is not finite; leave it out");
  const Vertices::Forest::Point point{position.x(), position.y(), position.z()};
  const auto known = vertices_->places.find(id);
  if (known != vertices_->places.end()) {
    if (known->second == point) return;
    vertices_->forest.Remove(known->second, id);
  }
  vertices_->places[id] = point;
  vertices_->forest.Add(point, id);
}

void ObjectGraph::Remove(int id) {
  const auto known = vertices_->places.find(id);
  if (known == vertices_->places.end()) return;
  vertices_->forest.Remove(known->second, id);
  vertices_->places.erase(known);
}

std::vector<GraphEdge> ObjectGraph::Neighbours(int id, int k) const {
  const auto known = vertices_->places.find(id);
  if (known == vertices_->places.end() || k <= 0) return {};
  std::vector<GraphEdge> edges = Nearest(Vec3(known->second.data()), k + 1);
  // The vertex itself is among them, unless more than k others are at the same place.
  const auto self = std::find_if(edges.begin(), edges.end(),
                                 [id](const GraphEdge& edge) { return edge.id == id; });
  if (self != edges.end())
    edges.erase(self);
  else
    edges.pop_back();
  return edges;
}

std::vector<GraphEdge> ObjectGraph::Nearest(const Vec3& point, int k) const {
  if (k <= 0 || !point.allFinite()) return {};
  BestK best(k);
  vertices_->forest.Search({point.x(), point.y(), point.z()}, best);
  return best.Take();
}

bool ObjectGraph::Contains(int id) const { return vertices_->places.count(id) > 0; }
int ObjectGraph::size() const { return static_cast<int>(vertices_->places.size()); }

}  // namespace sslcd
