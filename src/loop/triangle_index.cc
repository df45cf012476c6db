// SPDX-License-Identifier: BSD-3-Clause
#include "loop/triangle_index.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "loop/kd_forest.h"
#include "loop/layout_index.h"

namespace sslcd {
namespace {

// Number of neighbours: enough triangles remain if one of five is missed. Set by hand.
constexpr int kNeighbours = 6;
// Smallest length of the longest side, which determines the yaw. Set by hand. [m]
constexpr float kShortest = 4.f;

using Neighbours = std::array<int, kNeighbours>;  // -1: none

struct Near {
  float d2;
  int object;
  bool operator<(const Near& other) const {
    return d2 != other.d2 ? d2 < other.d2 : object < other.object;
  }
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

template <class T>
void MakeUnique(std::vector<T>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
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
  std::array<Corner, 3> corners{{{points[a].label, side(b, c), a},
                                 {points[b].label, side(a, c), b},
                                 {points[c].label, side(a, b), c}}};
  std::sort(corners.begin(), corners.end());
  ObjectTriangle triangle;
  for (int i = 0; i < 3; ++i) {
    triangle.vertex[i] = corners[i].vertex;
    triangle.side[i] = corners[i].side;
    triangle.label[i] = corners[i].label;
  }
  return triangle;
}

bool FixesYaw(const ObjectTriangle& triangle) {
  return *std::max_element(triangle.side.begin(), triangle.side.end()) >= kShortest;
}

std::vector<ObjectTriangle> Triangles(const std::vector<LayoutPoint>& points,
                                      const std::vector<Neighbours>& near) {
  std::vector<ObjectTriangle> triangles;
  for (int a = 0; a < static_cast<int>(points.size()); ++a) {
    for (int i = 0; i < kNeighbours && near[a][i] >= 0; ++i) {
      for (int j = i + 1; j < kNeighbours && near[a][j] >= 0; ++j) {
        const int b = near[a][i], c = near[a][j];
        // Two or three of its corners may propose it; only the first one does.
        if (b < a && Contains(near[b], a) && Contains(near[b], c)) continue;
        if (c < a && Contains(near[c], a) && Contains(near[c], b)) continue;
        const ObjectTriangle triangle = MakeTriangle(points, a, b, c);
        if (FixesYaw(triangle)) triangles.push_back(triangle);
      }
    }
  }
  return triangles;
}

using Vertices = std::array<int, 3>;  // ascending

void Propose(int a, const Neighbours& near, std::vector<Vertices>& proposed) {
  for (int i = 0; i < kNeighbours && near[i] >= 0; ++i) {
    for (int j = i + 1; j < kNeighbours && near[j] >= 0; ++j) {
      proposed.push_back({a, near[i], near[j]});
      std::sort(proposed.back().begin(), proposed.back().end());
    }
  }
}

Neighbours NearestOf(const LayoutIndex& index, int i, std::vector<Near>& found) {
  const std::vector<LayoutPoint>& points = index.points();
  const double start =
      std::sqrt(kNeighbours / (3. * index.density()));  // radius with about twice the number
  for (double radius = std::min(start, index.max_pair());;
       radius = std::min(2 * radius, index.max_pair())) {
    found.clear();
    const Vec2 centre(points[i].x, points[i].y), reach(radius, radius);
    index.VisitBox(centre - reach, centre + reach, [&](int j) {
      const float d2 = SquaredDistance(points[i], points[j]);
      if (j != i && d2 <= radius * radius) found.push_back({d2, j});
    });
    if (found.size() >= kNeighbours || radius >= index.max_pair()) return Nearest(found);
  }
}

std::vector<Neighbours> NearestOfAll(const LayoutIndex& index) {
  std::vector<Neighbours> near;
  std::vector<Near> found;
  for (int i = 0; i < static_cast<int>(index.points().size()); ++i)
    near.push_back(NearestOf(index, i, found));
  return near;
}

/// Finds the points within a radius, up to a limit.
struct Within {
  float squared_radius;
  std::size_t limit;
  std::vector<const ObjectTriangle*> triangles;

  float Reach2() const { return triangles.size() > limit ? -1.f : squared_radius; }
  void Visit(float, const ObjectTriangle& triangle, std::size_t) { triangles.push_back(&triangle); }
};

}  // namespace

std::vector<ObjectTriangle> NeighbourTriangles(const LayoutIndex& index) {
  return Triangles(index.points(), NearestOfAll(index));
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

struct TriangleIndex::State {
  using Forest = KdForest<float, ObjectTriangle>;
  std::vector<LayoutPoint> points;               // points of the last update
  std::vector<Neighbours> near;                  // neighbours that define the triangles
  std::map<std::array<int, 3>, Forest> forests;  // by labels

  // Points whose neighbours may have changed: those near the old or new positions of changed
  // points.
  template <class Visitor>
  void VisitAffected(const LayoutIndex& index, int changed, const LayoutPoint& place,
                     Visitor&& visit) const {
    const Vec2 centre(place.x, place.y), reach(index.max_pair(), index.max_pair());
    index.VisitBox(centre - reach, centre + reach, [&](int i) {
      if (i >= static_cast<int>(near.size())) return;
      const int last = near[i].back();
      if (last < 0 || Contains(near[i], changed) ||
          SquaredDistance(points[i], place) <= SquaredDistance(points[i], points[last]))
        visit(i);
    });
  }

  // The proposed triangles that exist.
  std::vector<ObjectTriangle> Existing(const std::vector<Vertices>& proposed) const {
    std::vector<ObjectTriangle> triangles;
    for (const Vertices& v : proposed) {
      if (v[2] >= static_cast<int>(near.size())) continue;
      const auto proposes = [&](int a, int b, int c) {
        return Contains(near[a], b) && Contains(near[a], c);
      };
      if (!proposes(v[0], v[1], v[2]) && !proposes(v[1], v[0], v[2]) && !proposes(v[2], v[0], v[1]))
        continue;
      const ObjectTriangle triangle = MakeTriangle(points, v[0], v[1], v[2]);
      if (FixesYaw(triangle)) triangles.push_back(triangle);
    }
    std::sort(triangles.begin(), triangles.end());
    return triangles;
  }
};

TriangleIndex::TriangleIndex(const LayoutIndex& index) : state_(std::make_unique<State>()) {
  state_->points = index.points();
  state_->near = NearestOfAll(index);
  std::map<std::array<int, 3>, std::vector<std::pair<State::Forest::Point, ObjectTriangle>>> groups;
  for (const ObjectTriangle& triangle : Triangles(state_->points, state_->near))
    groups[triangle.label].push_back({triangle.side, triangle});
  for (const auto& [labels, triangles] : groups) state_->forests[labels].Build(triangles);
}

TriangleIndex::TriangleIndex(const TriangleIndex& other)
    : state_(std::make_unique<State>(*other.state_)) {}

TriangleIndex::TriangleIndex(TriangleIndex&&) noexcept = default;
TriangleIndex& TriangleIndex::operator=(TriangleIndex&&) noexcept = default;
TriangleIndex::~TriangleIndex() = default;

void TriangleIndex::Update(const LayoutIndex& index, std::vector<int> changed) {
  State& s = *state_;
  std::vector<int> affected = changed;
  const auto add = [&](int i) { affected.push_back(i); };
  for (const int i : changed) {
    if (i < static_cast<int>(s.points.size())) s.VisitAffected(index, i, s.points[i], add);
    if (i < static_cast<int>(index.points().size()))
      s.VisitAffected(index, i, index.points()[i], add);
  }
  MakeUnique(affected);

  const std::size_t size = index.points().size();
  std::vector<std::pair<int, Neighbours>> now;
  std::vector<Vertices> proposed;
  std::vector<Near> found;
  for (const int i : affected) {
    if (i < static_cast<int>(s.near.size())) Propose(i, s.near[i], proposed);
    if (i >= static_cast<int>(size)) continue;
    now.push_back({i, NearestOf(index, i, found)});
    Propose(i, now.back().second, proposed);
  }
  MakeUnique(proposed);

  const std::vector<ObjectTriangle> before = s.Existing(proposed);
  s.points.resize(size);
  s.near.resize(size);
  for (const int i : affected)
    if (i < static_cast<int>(size)) s.points[i] = index.points()[i];
  for (const auto& [i, neighbours] : now) s.near[i] = neighbours;
  const std::vector<ObjectTriangle> after = s.Existing(proposed);

  std::vector<ObjectTriangle> gone, come;
  std::set_difference(before.begin(), before.end(), after.begin(), after.end(),
                      std::back_inserter(gone));
  std::set_difference(after.begin(), after.end(), before.begin(), before.end(),
                      std::back_inserter(come));
  for (const ObjectTriangle& triangle : gone)
    s.forests[triangle.label].Remove(triangle.side, triangle);
  for (const ObjectTriangle& triangle : come)
    s.forests[triangle.label].Add(triangle.side, triangle);
}

void TriangleIndex::Find(const ObjectTriangle& triangle, double radius_m, std::size_t limit,
                         std::vector<const ObjectTriangle*>& found) const {
  const auto forest = state_->forests.find(triangle.label);
  if (forest == state_->forests.end()) return;
  const float radius = static_cast<float>(radius_m);
  Within within{radius * radius, limit, {}};
  forest->second.Search(triangle.side, within);
  if (within.triangles.size() > limit) return;
  found.insert(found.end(), within.triangles.begin(), within.triangles.end());
}

}  // namespace sslcd
