// SPDX-License-Identifier: BSD-3-Clause
#include "loop/triangle_poses.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>

#include "loop/triangle_index.h"

namespace sslcd {
namespace {

// All set by hand, for maps of up to 100 000 objects (docs/notes, "Loop detection against the size
// of the map").
constexpr std::size_t kMaxTriangles = 400;  // of the local map, largest number of searches
constexpr std::size_t kMinTriangles = 40;   // number after which enough poses end the search
constexpr std::size_t kEnoughPoses = 5000;
constexpr std::size_t kMaxFound = 2000;  // largest number of results of one triangle
constexpr std::size_t kMaxPoses = 3000;  // largest number of poses to score
// The golden section: steps of this share of a list, modulo its length, spread any subset over it
// (Knuth, The Art of Computer Programming 3, 6.4).
constexpr double kGoldenSection = 0.618;
constexpr float kVoteMetres = 4.f;  // side of the cells in which poses are counted
constexpr float kVoteTurn = 0.4f;   // the same for the yaw as a point on the unit circle

// Aligns three points with three others; none if an error exceeds `tolerance`.
std::optional<CoarsePose> Align(const std::array<LayoutPoint, 3>& from,
                                const std::array<LayoutPoint, 3>& to, float tolerance) {
  LayoutPoint p, q;  // the centres
  for (int i = 0; i < 3; ++i) {
    p.x += from[i].x / 3;
    p.y += from[i].y / 3;
    p.z += from[i].z / 3;
    q.x += to[i].x / 3;
    q.y += to[i].y / 3;
    q.z += to[i].z / 3;
  }
  float dot = 0, cross = 0;
  for (int i = 0; i < 3; ++i) {
    const float ax = from[i].x - p.x, ay = from[i].y - p.y, bx = to[i].x - q.x, by = to[i].y - q.y;
    dot += ax * bx + ay * by;
    cross += ax * by - ay * bx;
  }
  const float norm = std::sqrt(dot * dot + cross * cross);
  if (!(norm > 0)) return std::nullopt;
  const float c = dot / norm, s = cross / norm;
  for (int i = 0; i < 3; ++i) {
    const float ax = from[i].x - p.x, ay = from[i].y - p.y;
    const float dx = c * ax - s * ay - (to[i].x - q.x), dy = s * ax + c * ay - (to[i].y - q.y);
    const float dz = from[i].z - p.z - (to[i].z - q.z);
    if (dx * dx + dy * dy > tolerance * tolerance || std::abs(dz) > tolerance) return std::nullopt;
  }
  CoarsePose pose;
  pose.cosine = c;
  pose.sine = s;
  pose.x = q.x - (c * p.x - s * p.y);
  pose.y = q.y - (s * p.x + c * p.y);
  pose.z = q.z - p.z;
  return pose;
}

// All alignments of `local` with `global` that respect labels and lengths.
void Lay(const ObjectTriangle& local, const std::vector<LayoutPoint>& points,
         const ObjectTriangle& global, const std::vector<LayoutPoint>& map, float tolerance,
         std::vector<CoarsePose>& poses) {
  constexpr int kOrders[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  for (const auto& order : kOrders) {
    bool fits = true;
    for (int i = 0; i < 3; ++i)
      fits &= local.label[i] == global.label[order[i]] &&
              std::abs(local.side[i] - global.side[order[i]]) <= tolerance;
    if (!fits) continue;
    std::array<LayoutPoint, 3> from, to;
    for (int i = 0; i < 3; ++i) {
      from[i] = points[local.vertex[i]];
      to[i] = map[global.vertex[order[i]]];
    }
    if (const auto pose = Align(from, to, tolerance)) poses.push_back(*pose);
  }
}

/// Counts the poses near a pose: hashed counters of cells (collisions are ignored) in two shifted
/// grids, so that neighbours on both sides of a cell's edge share a cell in one of them.
class Votes {
 public:
  explicit Votes(std::size_t poses) {
    while (mask_ < 4 * poses) mask_ = 2 * mask_ + 1;
    for (auto& grid : counts_) grid.assign(mask_ + 1, 0);
  }
  void Add(const CoarsePose& pose) {
    for (int grid = 0; grid < 2; ++grid) ++counts_[grid][Cell(pose, grid)];
  }
  int CountNear(const CoarsePose& pose) const {
    return std::max(counts_[0][Cell(pose, 0)], counts_[1][Cell(pose, 1)]);
  }

 private:
  std::size_t Cell(const CoarsePose& pose, int grid) const {
    const auto key = [&](float v, float size) {
      return static_cast<std::uint64_t>(
          static_cast<std::int64_t>(std::floor(v / size + 0.5f * static_cast<float>(grid))));
    };
    std::uint64_t hash = key(pose.x, kVoteMetres) * 0x9E3779B97F4A7C15u;
    hash = (hash ^ hash >> 29 ^ key(pose.y, kVoteMetres)) * 0xBF58476D1CE4E5B9u;
    hash = (hash ^ hash >> 32 ^ key(pose.cosine, kVoteTurn)) * 0x94D049BB133111EBu;
    hash = (hash ^ hash >> 29 ^ key(pose.sine, kVoteTurn)) * 0x9E3779B97F4A7C15u;
    return (hash >> 32) & mask_;
  }
  std::size_t mask_ = 1023;
  std::vector<int> counts_[2];
};

}  // namespace

std::vector<CoarsePose> TrianglePoses(const std::vector<LayoutPoint>& points,
                                      const LayoutIndex& index) {
  const float tolerance = static_cast<float>(kPairNoiseM);
  const std::vector<ObjectTriangle> triangles = NeighbourTriangles(points);
  const std::size_t used = std::min(triangles.size(), kMaxTriangles);
  std::size_t step = std::max<std::size_t>(
      1, static_cast<std::size_t>(kGoldenSection * static_cast<double>(triangles.size())));
  while (std::gcd(step, triangles.size()) > 1) ++step;
  std::vector<CoarsePose> poses;
  std::vector<ObjectTriangle> found;
  for (std::size_t k = 0; k < used && (k < kMinTriangles || poses.size() < kEnoughPoses); ++k) {
    const ObjectTriangle& triangle = triangles[k * step % triangles.size()];
    found.clear();
    index.triangles()->Find(index, triangle, kPairNoiseM, kMaxFound, found);
    for (const ObjectTriangle& other : found)
      Lay(triangle, points, other, index.points(), tolerance, poses);
  }
  Votes votes(poses.size());
  for (const CoarsePose& pose : poses) votes.Add(pose);
  for (CoarsePose& pose : poses) pose.score = static_cast<float>(votes.CountNear(pose));
  KeepBest(kMaxPoses, poses);
  return poses;
}

}  // namespace sslcd
