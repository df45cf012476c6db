// SPDX-License-Identifier: BSD-3-Clause
#include "loop/triangle_index.h"

#include <algorithm>
#include <cmath>

#include "loop/append.h"
#include "loop/layout_index.h"

namespace sslcd {
namespace {

using Neighbours = TriangleIndex::Neighbours;

// Number of neighbours: enough triangles remain if one of five is missed. Set by hand.
constexpr int kNeighbours = std::tuple_size<Neighbours>::value;
// Smallest length of the longest side, which determines the yaw. Set by hand. [m]
constexpr float kShortest = 4.f;

constexpr Neighbours kNone = {-1, -1, -1, -1, -1, -1};

// Cells of the first two sides: their length and number. Set by hand. [m]
constexpr float kCell = 0.5f;
constexpr int kCells = 256;
// Factor from the start of the search for neighbours to the usual distance. Set by hand.
constexpr double kUsual = 1.5;
// More than the rounding errors of distances (factor), of coordinates (factor) and of sides [m].
constexpr double kMargin = 1.1, kRoundingOfCoordinates = 1e-6;
constexpr float kRoundingOfSides = 1e-3f;

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
  Neighbours nearest = kNone;
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

// The triangle of vertices in their order.
ObjectTriangle Restore(const std::vector<LayoutPoint>& points, const std::array<int, 3>& vertex) {
  ObjectTriangle triangle;
  triangle.vertex = vertex;
  for (int i = 0; i < 3; ++i) {
    const LayoutPoint &a = points[vertex[(i + 1) % 3]], &b = points[vertex[(i + 2) % 3]];
    triangle.side[i] = std::sqrt(SquaredDistance(a, b));
    triangle.label[i] = points[vertex[i]].label;
  }
  return triangle;
}

bool FixesYaw(const ObjectTriangle& triangle) {
  return *std::max_element(triangle.side.begin(), triangle.side.end()) >= kShortest;
}

// Calls visit(triangle) for every triangle.
template <class Visitor>
void VisitTriangles(const std::vector<LayoutPoint>& points, const std::vector<Neighbours>& near,
                    Visitor&& visit) {
  for (int a = 0; a < static_cast<int>(points.size()); ++a) {
    for (int i = 0; i < kNeighbours && near[a][i] >= 0; ++i) {
      for (int j = i + 1; j < kNeighbours && near[a][j] >= 0; ++j) {
        const int b = near[a][i], c = near[a][j];
        // Two or three of its corners may propose it; only the first one does.
        if (b < a && Contains(near[b], a) && Contains(near[b], c)) continue;
        if (c < a && Contains(near[c], a) && Contains(near[c], b)) continue;
        const ObjectTriangle triangle = MakeTriangle(points, a, b, c);
        if (FixesYaw(triangle)) visit(triangle);
      }
    }
  }
}

std::vector<ObjectTriangle> Triangles(const std::vector<LayoutPoint>& points,
                                      const std::vector<Neighbours>& near) {
  std::vector<ObjectTriangle> triangles;
  VisitTriangles(points, near, [&](const ObjectTriangle& t) { triangles.push_back(t); });
  return triangles;
}

// Neighbours of points[i] with one more, without the farthest one.
Neighbours WithNeighbour(const std::vector<LayoutPoint>& points, int i, Neighbours near, int more) {
  Near next{SquaredDistance(points[i], points[more]), more};
  for (int& j : near) {
    if (j < 0) {
      j = next.object;
      break;
    }
    const Near other{SquaredDistance(points[i], points[j]), j};
    if (other < next) continue;
    j = next.object;
    next = other;
  }
  return near;
}

// Radius with about twice the number of neighbours. [m]
double UsualRadius(const LayoutIndex& index) {
  return std::sqrt(kNeighbours / (3. * index.density()));
}

Neighbours NearestOf(const LayoutIndex& index, int i, std::vector<Near>& found) {
  const std::vector<LayoutPoint>& points = index.points();
  const double start = UsualRadius(index);
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
  near.reserve(index.points().size());
  std::vector<Near> found;
  for (int i = 0; i < static_cast<int>(index.points().size()); ++i)
    near.push_back(NearestOf(index, i, found));
  return near;
}

int CellOf(float side) { return static_cast<int>(std::clamp(side / kCell, 0.f, kCells - 1.f)); }

// The first part of the search order. Different labels may share a number.
std::uint32_t ColumnOf(const std::array<int, 3>& label, int cell0, int cell1) {
  std::uint32_t hash = 0;
  for (const int l : label) hash = (hash + static_cast<std::uint32_t>(l)) * 0x9E3779B1u;
  return (hash >> 17) << 16 | static_cast<std::uint32_t>(cell0 * kCells + cell1);
}

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

TriangleIndex::TriangleIndex(const LayoutIndex& index)
    : near_(NearestOfAll(index)),
      usual_m_(kUsual * UsualRadius(index)),
      lonely_(kMargin * index.max_pair()) {
  const std::vector<LayoutPoint>& points = index.points();
  for (int i = 0; i < static_cast<int>(points.size()); ++i)
    if (IsLonely(points, i)) lonely_.Add(lonely_.Cell(points[i].x), lonely_.Cell(points[i].y), i);
  std::size_t count = 0;  // so that the list has no unused memory
  VisitTriangles(points, near_, [&](const ObjectTriangle&) { ++count; });
  std::vector<Entry> entries;
  entries.reserve(count);
  VisitTriangles(points, near_, [&](const ObjectTriangle& triangle) {
    entries.push_back(EntryOf(triangle, false));
  });
  std::sort(entries.begin(), entries.end());
  triangles_ = SortedRuns<Entry>(std::move(entries));
}

TriangleIndex::Entry TriangleIndex::EntryOf(const ObjectTriangle& t, bool removed) {
  return {ColumnOf(t.label, CellOf(t.side[0]), CellOf(t.side[1])), removed, t.side[2], t.vertex};
}

// Ranges with all entries whose sides differ by up to `radius`.
std::vector<SortedRuns<TriangleIndex::Entry>::Range> TriangleIndex::Ranges(
    const ObjectTriangle& triangle, float radius) {
  const std::array<float, 3>& side = triangle.side;
  const auto gap = [&](int i, int cell) {  // from side[i] to a cell
    const float low = static_cast<float>(cell) * kCell, high = low + kCell;
    if (side[i] < low) return low - side[i];
    return cell < kCells - 1 && side[i] > high ? side[i] - high : 0.f;
  };
  std::vector<SortedRuns<Entry>::Range> ranges;
  const int last0 = CellOf(side[0] + radius), last1 = CellOf(side[1] + radius);
  for (int cell0 = CellOf(side[0] - radius); cell0 <= last0; ++cell0) {
    for (int cell1 = CellOf(side[1] - radius); cell1 <= last1; ++cell1) {
      const float reach2 =
          radius * radius - gap(0, cell0) * gap(0, cell0) - gap(1, cell1) * gap(1, cell1);
      if (reach2 < 0) continue;
      const float reach = std::sqrt(reach2) + kRoundingOfSides;
      const std::uint32_t column = ColumnOf(triangle.label, cell0, cell1);
      ranges.push_back(
          {{column, false, side[2] - reach, {}}, {column, false, side[2] + reach, {}}});
    }
  }
  return ranges;
}

bool TriangleIndex::Proposes(int a, int b, int c) const {
  return Contains(near_[a], b) && Contains(near_[a], c);
}

bool TriangleIndex::IsLonely(const std::vector<LayoutPoint>& points, int a) const {
  const int last = near_[a].back();
  return last < 0 || SquaredDistance(points[a], points[last]) > usual_m_ * usual_m_;
}

// Objects that have points[place] among their neighbours or as near as these.
std::vector<int> TriangleIndex::Around(const LayoutIndex& index, int place) const {
  const std::vector<LayoutPoint>& points = index.points();
  const LayoutPoint& centre = points[place];
  const double most2 = index.max_pair() * index.max_pair();
  std::vector<int> around;
  const auto add = [&](int i) {
    const int last = near_[i].back();
    const double reach2 = last < 0 ? most2 : SquaredDistance(points[i], points[last]);
    if (SquaredDistance(points[i], centre) <= reach2) around.push_back(i);
  };
  const Vec2 middle(centre.x, centre.y);
  const double reach = kMargin * usual_m_ + kRoundingOfCoordinates * middle.norm();
  index.VisitBox(middle - Vec2::Constant(reach), middle + Vec2::Constant(reach), [&](int i) {
    if (i != place && !IsLonely(points, i)) add(i);
  });
  const int column = lonely_.Cell(centre.x), row = lonely_.Cell(centre.y);
  for (int k = 0; k < 9; ++k)
    for (const int i : lonely_.At(column + k / 3 - 1, row + k % 3 - 1))
      if (i != place) add(i);
  return around;
}

// Changes the neighbours of `a`, and the triangles that no other corner proposes.
void TriangleIndex::SetNeighbours(const std::vector<LayoutPoint>& points, int a,
                                  const Neighbours& now) {
  const Neighbours before = near_[a];
  const bool was_lonely = IsLonely(points, a);
  near_[a] = now;
  const int column = lonely_.Cell(points[a].x), row = lonely_.Cell(points[a].y);
  if (was_lonely && !IsLonely(points, a)) lonely_.Remove(column, row, a);
  if (!was_lonely && IsLonely(points, a)) lonely_.Add(column, row, a);
  // The triangles of the pairs of `in` that are not in `not_in`.
  const auto change = [&](const Neighbours& in, const Neighbours& not_in, bool removed) {
    for (int i = 0; i < kNeighbours && in[i] >= 0; ++i) {
      const bool kept = Contains(not_in, in[i]);
      for (int j = i + 1; j < kNeighbours && in[j] >= 0; ++j) {
        if (kept && Contains(not_in, in[j])) continue;
        if (Proposes(in[i], a, in[j]) || Proposes(in[j], a, in[i])) continue;
        const ObjectTriangle triangle = MakeTriangle(points, a, in[i], in[j]);
        if (FixesYaw(triangle)) triangles_.Change(EntryOf(triangle, removed));
      }
    }
  };
  change(before, now, true);
  change(now, before, false);
}

void TriangleIndex::Add(const LayoutIndex& index, int added) {
  const std::vector<LayoutPoint>& points = index.points();
  while (near_.size() < points.size()) Append(near_) = kNone;
  lonely_.Add(lonely_.Cell(points[added].x), lonely_.Cell(points[added].y), added);
  std::vector<Near> found;
  SetNeighbours(points, added, NearestOf(index, added, found));
  for (const int i : Around(index, added))
    SetNeighbours(points, i, WithNeighbour(points, i, near_[i], added));
}

void TriangleIndex::Remove(const LayoutIndex& index, int removed) {
  const std::vector<LayoutPoint>& points = index.points();
  std::vector<Near> found;
  for (const int i : Around(index, removed))
    if (Contains(near_[i], removed)) SetNeighbours(points, i, NearestOf(index, i, found));
  SetNeighbours(points, removed, kNone);
  lonely_.Remove(lonely_.Cell(points[removed].x), lonely_.Cell(points[removed].y), removed);
}

void TriangleIndex::Find(const LayoutIndex& index, const ObjectTriangle& triangle, double radius_m,
                         std::size_t limit, std::vector<ObjectTriangle>& found) const {
  const float radius = static_cast<float>(radius_m), radius2 = radius * radius;
  const auto restored = [&](const Entry& entry) { return Restore(index.points(), entry.vertex); };
  const std::optional<std::vector<Entry>> entries =
      triangles_.Find(Ranges(triangle, radius), limit, [&](const Entry& entry) {
        const int size = static_cast<int>(index.points().size());
        for (const int v : entry.vertex)
          if (v >= size) return false;  // removed
        const ObjectTriangle other = restored(entry);
        float d2 = 0;
        for (int i = 0; i < 3; ++i)
          d2 += (other.side[i] - triangle.side[i]) * (other.side[i] - triangle.side[i]);
        return other.label == triangle.label && d2 < radius2;
      });
  if (!entries) return;
  for (const Entry& entry : *entries) found.push_back(restored(entry));
}

}  // namespace sslcd
