// SPDX-License-Identifier: BSD-3-Clause
#include "loop/coarse_poses.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "loop/triangle_poses.h"

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

/// Scores poses as they are proposed and keeps the best of each cell of poses.
class Contest {
 public:
  Contest(const std::vector<LayoutPoint>& points, const LayoutIndex& index, const PoseSearchOptions& options)
      : points_(points), index_(index), inlier2_(static_cast<float>(options.inlier_m * options.inlier_m)) {}

  void Enter(CoarsePose pose) {
    pose.score = Score(pose);
    if (pose.score < 0.4f * best_) return;
    best_ = std::max(best_, pose.score);
    const auto key = [](double v) { return static_cast<std::int64_t>(std::floor(v)) & 0xfffff; };
    const std::int64_t cell = key(std::atan2(pose.sine, pose.cosine) / 0.1) << 40 | key(pose.x) << 20 | key(pose.y);
    CoarsePose& kept = cells_[cell];
    if (pose.score > kept.score) kept = pose;
  }

  std::vector<CoarsePose> Best(std::size_t count) const {
    std::vector<CoarsePose> coarse;
    for (const auto& [cell, pose] : cells_)
      if (pose.score >= 0.5f * best_) coarse.push_back(pose);
    const auto better = [](const CoarsePose& a, const CoarsePose& b) {
      if (a.score != b.score) return a.score > b.score;
      if (a.x != b.x) return a.x < b.x;
      return a.y != b.y ? a.y < b.y : a.sine < b.sine;
    };
    const std::size_t keep = std::min(coarse.size(), count);
    std::partial_sort(coarse.begin(), coarse.begin() + static_cast<std::ptrdiff_t>(keep), coarse.end(), better);
    coarse.resize(keep);
    return coarse;
  }

 private:
  float Score(const CoarsePose& pose) const {
    const std::vector<LayoutPoint>& map = index_.points();
    float score = 0, open = static_cast<float>(points_.size());  // what the other points may add
    for (const LayoutPoint& p : points_) {
      const float x = pose.cosine * p.x - pose.sine * p.y + pose.x, y = pose.sine * p.x + pose.cosine * p.y + pose.y;
      float gain = 0;
      for (const int j : index_.Near(x, y)) {
        const float dx = map[j].x - x, dy = map[j].y - y, dz = map[j].z - p.z - pose.z;
        const float d2 = dx * dx + dy * dy + dz * dz;
        if (d2 >= inlier2_) continue;
        gain = std::max(gain, (1 - d2 / inlier2_) * (map[j].label == p.label ? 1.f : .3f));
      }
      score += gain;
      open -= 1;
      if (score + open < 0.4f * best_) break;
    }
    return score;
  }

  const std::vector<LayoutPoint>& points_;
  const LayoutIndex& index_;
  float inlier2_, best_ = 0;
  std::unordered_map<std::int64_t, CoarsePose> cells_;
};

// Every chosen local pair on every global pair of equal distance.
void EnterPairs(const std::vector<LayoutObject>& local, const std::vector<LayoutPoint>& points,
                const LayoutIndex& index, const PoseSearchOptions& options, Contest& contest) {
  const std::vector<LayoutPoint>& map = index.points();
  const float tolerance = static_cast<float>(options.pair_noise_m);
  for (const LocalPair& chosen : ChoosePairs(local, index, options)) {
    const ObjectPair& l = chosen.pair;
    const LayoutPoint &pa = points[l.a], &pb = points[l.b];
    const auto end = index.PairsEnd(pa.label, pb.label, l.distance + options.pair_noise_m);
    for (auto g = index.PairsBegin(pa.label, pb.label, l.distance - options.pair_noise_m); g < end; ++g) {
      if (std::abs(g->distance - l.distance) > tolerance) continue;
      if (map[g->a].label != pa.label || map[g->b].label != pb.label) continue;
      for (int flip = 0; flip < (pa.label == pb.label ? 2 : 1); ++flip) {
        const float sign = flip ? -1.f : 1.f;
        if (std::abs(sign * g->dz - l.dz) > tolerance) continue;
        const float c = sign * (g->dx * l.dx + g->dy * l.dy), s = sign * (g->dy * l.dx - g->dx * l.dy);
        const LayoutPoint &qa = map[flip ? g->b : g->a], &qb = map[flip ? g->a : g->b];
        const float mx = (pa.x + pb.x) / 2, my = (pa.y + pb.y) / 2;
        CoarsePose pose;
        pose.cosine = c;
        pose.sine = s;
        pose.x = (qa.x + qb.x) / 2 - (c * mx - s * my);
        pose.y = (qa.y + qb.y) / 2 - (s * mx + c * my);
        pose.z = (qa.z + qb.z) / 2 - (pa.z + pb.z) / 2;
        contest.Enter(pose);
      }
    }
  }
}

}  // namespace

std::vector<CoarsePose> CoarsePoses(const std::vector<LayoutObject>& local, const Vec3& centre,
                                    const LayoutIndex& index, const PoseSearchOptions& options) {
  std::vector<LayoutPoint> points;
  for (const LayoutObject& object : local) {
    const Eigen::Vector3f p = (object.position - centre).cast<float>();
    points.push_back({p.x(), p.y(), p.z(), object.label});
  }
  Contest contest(points, index, options);
  if (index.triangles() == nullptr)
    EnterPairs(local, points, index, options, contest);
  else
    for (const CoarsePose& pose : TrianglePoses(points, index, options)) contest.Enter(pose);
  return contest.Best(options.refine);
}

}  // namespace sslcd
