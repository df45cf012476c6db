// SPDX-License-Identifier: BSD-3-Clause
#include "loop/triangle_index.h"

#include <flann/algorithms/dist.h>
#include <flann/algorithms/kdtree_single_index.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "sslcd/loop/layout_index.h"

namespace sslcd {
namespace {

using Tree = flann::KDTreeSingleIndex<flann::L2_3D<float>>;
constexpr int kNeighbours = 6;    // enough for triangles that are left when one neighbour of five is missed
constexpr float kShortest = 4.f;  // the longest side at least, for the sake of the yaw [m]

using Neighbours = std::array<int, kNeighbours>;  // -1: none

struct Near {
  float d2;
  int object;
  bool operator<(const Near& other) const { return d2 != other.d2 ? d2 < other.d2 : object < other.object; }
};

float SquaredDistance(const LayoutPoint& a, const LayoutPoint& b) {
  return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y);
}

Neighbours Nearest(std::vector<Near>& all) {
  const std::size_t n = std::min<std::size_t>(all.size(), kNeighbours);
  std::partial_sort(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(n), all.end());
  Neighbours nearest;
  nearest.fill(-1);
  for (std::size_t i = 0; i < n; ++i) nearest[i] = all[i].object;
  return nearest;
}

bool Contains(const Neighbours& neighbours, int object) {
  return std::find(neighbours.begin(), neighbours.end(), object) != neighbours.end();
}

ObjectTriangle MakeTriangle(const std::vector<LayoutPoint>& points, int a, int b, int c) {
  struct Corner {
    int label;
    float side;
    int vertex;
    bool operator<(const Corner& o) const {
      return std::tie(label, side, vertex) < std::tie(o.label, o.side, o.vertex);
    }
  };
  const auto side = [&](int i, int j) { return std::sqrt(SquaredDistance(points[i], points[j])); };
  std::array<Corner, 3> corners{
      {{points[a].label, side(b, c), a}, {points[b].label, side(a, c), b}, {points[c].label, side(a, b), c}}};
  std::sort(corners.begin(), corners.end());
  ObjectTriangle triangle;
  for (int i = 0; i < 3; ++i) {
    triangle.vertex[i] = corners[i].vertex;
    triangle.side[i] = corners[i].side;
    triangle.label[i] = corners[i].label;
  }
  return triangle;
}

std::vector<ObjectTriangle> Triangles(const std::vector<LayoutPoint>& points, const std::vector<Neighbours>& near) {
  std::vector<ObjectTriangle> triangles;
  for (int a = 0; a < static_cast<int>(points.size()); ++a) {
    for (int i = 0; i < kNeighbours && near[a][i] >= 0; ++i) {
      for (int j = i + 1; j < kNeighbours && near[a][j] >= 0; ++j) {
        const int b = near[a][i], c = near[a][j];
        // Two or three of its corners may propose it: the first one does.
        if (b < a && Contains(near[b], a) && Contains(near[b], c)) continue;
        if (c < a && Contains(near[c], a) && Contains(near[c], b)) continue;
        const ObjectTriangle triangle = MakeTriangle(points, a, b, c);
        if (*std::max_element(triangle.side.begin(), triangle.side.end()) >= kShortest) triangles.push_back(triangle);
      }
    }
  }
  return triangles;
}

/// What lies within a radius, unless it is too much.
class Within : public flann::ResultSet<float> {
 public:
  Within(float radius, std::size_t limit) : squared_(radius * radius), limit_(limit) {}
  bool full() const override { return true; }
  float worstDist() const override { return rows.size() > limit_ ? -1.f : squared_; }
  void addPoint(float squared_distance, std::size_t row) override {
    if (squared_distance < squared_ && rows.size() <= limit_) rows.push_back(row);
  }
  std::vector<std::size_t> rows;

 private:
  float squared_;
  std::size_t limit_;
};

}  // namespace

std::vector<ObjectTriangle> NeighbourTriangles(const LayoutIndex& index) {
  const std::vector<LayoutPoint>& points = index.points();
  std::vector<Neighbours> near(points.size());
  const double start = std::sqrt(kNeighbours / (3. * index.density()));  // about twice as many
  std::vector<Near> found;
  for (int i = 0; i < static_cast<int>(points.size()); ++i) {
    for (double radius = std::min(start, index.max_pair());; radius = std::min(2 * radius, index.max_pair())) {
      found.clear();
      const Vec2 centre(points[i].x, points[i].y), reach(radius, radius);
      index.VisitBox(centre - reach, centre + reach, [&](int j) {
        const float d2 = SquaredDistance(points[i], points[j]);
        if (j != i && d2 <= radius * radius) found.push_back({d2, j});
      });
      if (found.size() >= kNeighbours || radius >= index.max_pair()) break;
    }
    near[i] = Nearest(found);
  }
  return Triangles(points, near);
}

std::vector<ObjectTriangle> NeighbourTriangles(const std::vector<LayoutPoint>& points) {
  std::vector<Neighbours> near;
  std::vector<Near> found;
  for (int i = 0; i < static_cast<int>(points.size()); ++i) {
    found.clear();
    for (int j = 0; j < static_cast<int>(points.size()); ++j)
      if (j != i) found.push_back({SquaredDistance(points[i], points[j]), j});
    near.push_back(Nearest(found));
  }
  return Triangles(points, near);
}

struct TriangleIndex::Trees {
  struct Group {
    std::vector<ObjectTriangle> triangles;
    std::vector<float> sides;  // of each triangle, what the tree is over
    std::unique_ptr<Tree> tree;
  };
  std::map<std::array<int, 3>, Group> groups;  // by labels
};

TriangleIndex::TriangleIndex(const LayoutIndex& index) : trees_(std::make_unique<Trees>()) {
  for (const ObjectTriangle& triangle : NeighbourTriangles(index)) {
    Trees::Group& group = trees_->groups[triangle.label];
    group.triangles.push_back(triangle);
    group.sides.insert(group.sides.end(), triangle.side.begin(), triangle.side.end());
  }
  for (auto& [labels, group] : trees_->groups) {
    group.tree = std::make_unique<Tree>(flann::Matrix<float>(group.sides.data(), group.triangles.size(), 3));
    group.tree->buildIndex();
  }
}

TriangleIndex::~TriangleIndex() = default;

void TriangleIndex::Find(const ObjectTriangle& triangle, double radius_m, std::size_t limit,
                         std::vector<const ObjectTriangle*>& found) const {
  const auto group = trees_->groups.find(triangle.label);
  if (group == trees_->groups.end()) return;
  Within within(static_cast<float>(radius_m), limit);
  group->second.tree->findNeighbors(within, triangle.side.data(), flann::SearchParams());
  if (within.rows.size() > limit) return;
  for (const std::size_t row : within.rows) found.push_back(&group->second.triangles[row]);
}

}  // namespace sslcd
