// SPDX-License-Identifier: BSD-3-Clause
#include "loop/coarse_poses.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace sslcd {
namespace {

struct LocalPair {
  ObjectPair pair;
  int matches = 0;  // global pairs that may equal it
};

// The local pairs to be laid on the map: long enough, few of their kind, every object in some of them.
std::vector<LocalPair> ChoosePairs(const std::vector<LayoutObject>& local, const LayoutIndex& index,
                                   const PoseSearchOptions& options) {
  std::vector<LocalPair> pairs;
  for (int i = 0; i < static_cast<int>(local.size()); ++i) {
    for (int j = i + 1; j < static_cast<int>(local.size()); ++j) {
      int a = i, b = j;
      if (local[a].label > local[b].label) std::swap(a, b);
      const Vec3 step = local[b].position - local[a].position;
      const double distance = std::hypot(step.x(), step.y());
      if (distance < options.min_pair_m || distance > index.max_pair()) continue;
      const auto begin = index.PairsBegin(local[a].label, local[b].label, distance - options.pair_noise_m);
      const auto end = index.PairsEnd(local[a].label, local[b].label, distance + options.pair_noise_m);
      if (end <= begin) continue;
      LocalPair pair;
      pair.pair = {a,
                   b,
                   static_cast<float>(distance),
                   static_cast<float>(step.x() / distance),
                   static_cast<float>(step.y() / distance),
                   static_cast<float>(step.z())};
      pair.matches = static_cast<int>(end - begin);
      pairs.push_back(pair);
    }
  }
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const LocalPair& a, const LocalPair& b) { return a.matches < b.matches; });
  std::vector<int> used(local.size(), 0);
  std::vector<LocalPair> chosen;
  for (const LocalPair& pair : pairs) {
    if (std::min(used[pair.pair.a], used[pair.pair.b]) >= options.pairs_per_object) continue;
    ++used[pair.pair.a];
    ++used[pair.pair.b];
    chosen.push_back(pair);
  }
  return chosen;
}

}  // namespace

std::vector<CoarsePose> CoarsePoses(const std::vector<LayoutObject>& local, const Vec3& centre,
                                    const LayoutIndex& index, const PoseSearchOptions& options) {
  struct Point {
    float x, y, z;
    int label;
  };
  std::vector<Point> points;
  for (const LayoutObject& object : local)
    points.push_back({static_cast<float>(object.position.x() - centre.x()),
                      static_cast<float>(object.position.y() - centre.y()),
                      static_cast<float>(object.position.z() - centre.z()), object.label});
  std::vector<Point> map;
  for (const LayoutObject& object : index.objects())
    map.push_back({static_cast<float>(object.position.x()), static_cast<float>(object.position.y()),
                   static_cast<float>(object.position.z()), object.label});

  std::unordered_map<std::int64_t, CoarsePose> cells;
  const float inlier2 = static_cast<float>(options.inlier_m * options.inlier_m);
  float best = 0;
  for (const LocalPair& chosen : ChoosePairs(local, index, options)) {
    const ObjectPair& l = chosen.pair;
    const Point &pa = points[l.a], &pb = points[l.b];
    const float tolerance = static_cast<float>(options.pair_noise_m);
    const auto end = index.PairsEnd(local[l.a].label, local[l.b].label, l.distance + options.pair_noise_m);
    const bool same = pa.label == pb.label;
    for (auto g = index.PairsBegin(local[l.a].label, local[l.b].label, l.distance - options.pair_noise_m); g < end;
         ++g) {
      if (std::abs(g->distance - l.distance) > tolerance) continue;
      for (int flip = 0; flip < (same ? 2 : 1); ++flip) {
        const float sign = flip ? -1.f : 1.f;
        if (std::abs(sign * g->dz - l.dz) > tolerance) continue;
        const float c = sign * (g->dx * l.dx + g->dy * l.dy), s = sign * (g->dy * l.dx - g->dx * l.dy);
        const Point &qa = map[flip ? g->b : g->a], &qb = map[flip ? g->a : g->b];
        const float mx = (pa.x + pb.x) / 2, my = (pa.y + pb.y) / 2;
        CoarsePose pose;
        pose.cosine = c;
        pose.sine = s;
        pose.x = (qa.x + qb.x) / 2 - (c * mx - s * my);
        pose.y = (qa.y + qb.y) / 2 - (s * mx + c * my);
        pose.z = (qa.z + qb.z) / 2 - (pa.z + pb.z) / 2;
        float score = 0;
        for (const Point& p : points) {
          const float x = c * p.x - s * p.y + pose.x, y = s * p.x + c * p.y + pose.y;
          float gain = 0;
          for (const int j : index.Near(x, y)) {
            const float dx = map[j].x - x, dy = map[j].y - y, dz = map[j].z - p.z - pose.z;
            const float d2 = dx * dx + dy * dy + dz * dz;
            if (d2 >= inlier2) continue;
            gain = std::max(gain, (1 - d2 / inlier2) * (map[j].label == p.label ? 1.f : .3f));
          }
          score += gain;
        }
        if (score < 0.4f * best) continue;
        best = std::max(best, score);
        pose.score = score;
        const auto key = [](double v) { return static_cast<std::int64_t>(std::floor(v)) & 0xfffff; };
        const std::int64_t cell = key(std::atan2(s, c) / 0.1) << 40 | key(pose.x) << 20 | key(pose.y);
        CoarsePose& kept = cells[cell];
        if (score > kept.score) kept = pose;
      }
    }
  }

  std::vector<CoarsePose> coarse;
  for (const auto& [cell, pose] : cells)
    if (pose.score >= 0.5f * best) coarse.push_back(pose);
  const auto better = [](const CoarsePose& a, const CoarsePose& b) {
    if (a.score != b.score) return a.score > b.score;
    if (a.x != b.x) return a.x < b.x;
    return a.y != b.y ? a.y < b.y : a.sine < b.sine;
  };
  const std::size_t keep = std::min<std::size_t>(coarse.size(), options.refine);
  std::partial_sort(coarse.begin(), coarse.begin() + static_cast<std::ptrdiff_t>(keep), coarse.end(), better);
  coarse.resize(keep);
  return coarse;
}

}  // namespace sslcd
