// SPDX-License-Identifier: BSD-3-Clause
#include "loop/coarse_poses.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <unordered_map>

#include "loop/large_map_poses.h"

namespace sslcd {
namespace {

// Number of local pairs per object, those with the fewest equal pairs in the map first. Layouts of
// many objects find no more with six (object pairs, all sequences). Set by hand.
int PairsPerObject(std::size_t objects) { return objects < 32 ? 6 : 5; }
// Soft score of an object that coincides with one of another label, share of a correct match. Set
// by hand.
constexpr float kOtherLabelScore = 0.3f;
// Poses in the same cell are equal: cells of 1 m and of this yaw. Set by hand.
constexpr double kSameYawRad = 0.1;
// Smallest score of a refined pose, share of the best score. Set by hand.
constexpr float kShareOfBest = 0.5f;

struct LocalPair {
  ObjectPair pair;
  int matches = 0;  // number of possibly equal global pairs
};

// Selects the local pairs to align with the map: long and rare pairs that cover every object.
std::vector<LocalPair> ChoosePairs(const std::vector<LayoutObject>& local,
                                   const LayoutIndex& index) {
  std::vector<LocalPair> pairs;
  for (int i = 0; i < static_cast<int>(local.size()); ++i) {
    for (int j = i + 1; j < static_cast<int>(local.size()); ++j) {
      int a = i, b = j;
      if (local[a].label > local[b].label) std::swap(a, b);
      const Vec3 step = local[b].position - local[a].position;
      const double distance = std::hypot(step.x(), step.y());
      if (distance < kMinPairM || distance > index.max_pair()) continue;
      const PairIndex::Range similar = index.pairs().Between(
          local[a].label, local[b].label, distance - kPairNoiseM, distance + kPairNoiseM);
      if (similar.empty()) continue;
      LocalPair pair;
      pair.pair = {a,
                   b,
                   static_cast<float>(distance),
                   static_cast<float>(step.x() / distance),
                   static_cast<float>(step.y() / distance),
                   static_cast<float>(step.z())};
      pair.matches = static_cast<int>(similar.last - similar.first);
      pairs.push_back(pair);
    }
  }
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const LocalPair& a, const LocalPair& b) { return a.matches < b.matches; });
  const int per_object = PairsPerObject(local.size());
  std::vector<int> used(local.size(), 0);
  std::vector<LocalPair> chosen;
  for (const LocalPair& pair : pairs) {
    if (std::min(used[pair.pair.a], used[pair.pair.b]) >= per_object) continue;
    ++used[pair.pair.a];
    ++used[pair.pair.b];
    chosen.push_back(pair);
  }
  return chosen;
}

/// A grid with the upper bound of a point's gain by its position. One lookup replaces a search of
/// the objects nearby.
class GainBound {
 public:
  static constexpr int kOne = 250;  // a gain of 1, in the picture's units
  static constexpr int kBatch = 8;  // points per vectorised lookup

  GainBound(const std::vector<LayoutPoint>& map, float inlier_m) : inlier_(inlier_m) {
    constexpr float kFinest = 0.5f, kMaxSide = 1024;  // [m], cells
    Eigen::AlignedBox2f box;
    for (const LayoutPoint& p : map) box.extend(Eigen::Vector2f(p.x, p.y));
    const Eigen::Vector2f size = box.sizes() + Eigen::Vector2f::Constant(2 * inlier_);
    cell_ = std::max(kFinest, size.maxCoeff() / (kMaxSide - 4));
    per_cell_ = 1 / cell_;
    // no gain on the border
    low_ = box.min() - Eigen::Vector2f::Constant(inlier_ + 2 * cell_);
    last_column_ = std::floor(size.x() / cell_) + 3;
    last_row_ = std::floor(size.y() / cell_) + 3;
    while (1 << shift_ <= static_cast<int>(last_column_)) ++shift_;
    bound_.assign(static_cast<std::size_t>(last_row_ + 1) << shift_, 0);
    for (const LayoutPoint& p : map) Paint(p.x - low_.x(), p.y - low_.y());
  }

  /// A pose in cells.
  struct GridPose {
    float c, s, x, y;
  };
  GridPose ToGrid(const CoarsePose& pose) const {
    return {pose.cosine * per_cell_, pose.sine * per_cell_, (pose.x - low_.x()) * per_cell_,
            (pose.y - low_.y()) * per_cell_};
  }

  /// Upper bounds of the gains of kBatch points at (x, y) before the transform, and their sum.
  /// Compilers vectorise the first loop.
  int BoundGains(const GridPose& at, const float* x, const float* y, std::uint8_t* bounds) const {
    int cells[kBatch], sum = 0;
    for (int i = 0; i < kBatch; ++i) {
      const float column = at.c * x[i] - at.s * y[i] + at.x, row = at.s * x[i] + at.c * y[i] + at.y;
      const float inner_column = std::min(std::max(column, 0.f), last_column_);
      const float inner_row = std::min(std::max(row, 0.f), last_row_);
      cells[i] = (static_cast<int>(inner_row) << shift_) + static_cast<int>(inner_column);
    }
    for (int i = 0; i < kBatch; ++i) sum += bounds[i] = bound_[cells[i]];
    return sum;
  }

 private:
  void Paint(float x, float y) {
    constexpr float kRounding = 0.01f;  // bound of the rounding of coordinates [m]
    const float reach = inlier_ + kRounding;
    const auto apart = [&](float v, int i) {  // distance of a coordinate from a row of cells
      const float from = static_cast<float>(i) * cell_ - kRounding,
                  to = from + cell_ + 2 * kRounding;
      return std::max({0.f, from - v, v - to});
    };
    for (int row = static_cast<int>((y - reach) / cell_);
         row <= static_cast<int>((y + reach) / cell_); ++row) {
      for (int column = static_cast<int>((x - reach) / cell_);
           column <= static_cast<int>((x + reach) / cell_); ++column) {
        const float dx = apart(x, column), dy = apart(y, row);
        const float most = 1 - (dx * dx + dy * dy) / (inlier_ * inlier_);
        std::uint8_t& bound =
            bound_[(static_cast<std::size_t>(row) << shift_) + static_cast<std::size_t>(column)];
        if (most > 0)
          bound = std::max(bound, static_cast<std::uint8_t>(static_cast<float>(kOne) * most + 1));
      }
    }
  }

  float inlier_, cell_ = 1, per_cell_ = 1, last_column_ = 0, last_row_ = 0;
  Eigen::Vector2f low_;
  int shift_ = 0;
  std::vector<std::uint8_t> bound_;  // rows of 2^shift_ cells [1/kOne]
};

/// Scores proposed poses and keeps the best one of each cell of the pose space.
class TopPoses {
 public:
  TopPoses(const std::vector<LayoutPoint>& points, const LayoutIndex& index,
           const PoseSearchOptions& options)
      : points_(points),
        index_(index),
        bound_(index.points(), static_cast<float>(kCoarseInlierM)),
        inlier2_(static_cast<float>(kCoarseInlierM * kCoarseInlierM)),
        capacity_(options.refine) {
    const std::size_t padded = points.size() + GainBound::kBatch;
    x_.resize(padded, 0.f);
    y_.resize(padded, 0.f);
    bounds_.resize(padded, GainBound::kOne);
    for (std::size_t i = 0; i < points.size(); ++i) {
      x_[i] = points[i].x;
      y_[i] = points[i].y;
    }
  }

  void Propose(CoarsePose pose) {
    ++looked_at_;
    pose.score = CanReachThreshold(pose) ? Score(pose) : 0;
    if (!(pose.score >= threshold_)) return;
    const auto key = [](double v) { return static_cast<std::int64_t>(std::floor(v)) & 0xfffff; };
    const std::int64_t cell = key(std::atan2(pose.sine, pose.cosine) / kSameYawRad) << 40 |
                              key(pose.x) << 20 | key(pose.y);
    CoarsePose& kept = cells_[cell];
    if (pose.score > kept.score) kept = pose;
    RaiseThreshold(pose.score);
  }

  std::size_t looked_at() const { return looked_at_; }

  std::vector<CoarsePose> Best() const {
    std::vector<CoarsePose> coarse;
    for (const auto& [cell, pose] : cells_)
      if (pose.score >= threshold_) coarse.push_back(pose);
    const std::size_t keep = std::min(coarse.size(), capacity_);
    std::partial_sort(coarse.begin(), coarse.begin() + static_cast<std::ptrdiff_t>(keep),
                      coarse.end(), IsBetter);
    coarse.resize(keep);
    return coarse;
  }

 private:
  // Could the pose reach threshold_? Leaves the points behind that gain something.
  bool CanReachThreshold(const CoarsePose& pose) {
    if (!BoundPoints(pose)) return false;
    total_bound_ = 0;
    candidates_.clear();
    for (int i = 0; i < static_cast<int>(points_.size()); ++i) {
      total_bound_ += bounds_[i];
      if (bounds_[i] > 0) candidates_.push_back({i, bounds_[i]});
    }
    return true;
  }

  bool BoundPoints(const CoarsePose& pose) {
    const int needed = NeededGain(0), count = static_cast<int>(points_.size());
    const GainBound::GridPose at = bound_.ToGrid(pose);
    int most = 0;
    for (int first = 0; first < count; first += GainBound::kBatch) {
      const int others = std::max(0, count - first - GainBound::kBatch);
      most += bound_.BoundGains(at, &x_[first], &y_[first], &bounds_[first]);
      if (most + GainBound::kOne * others < needed) return false;
    }
    return true;
  }

  float Score(const CoarsePose& pose) const {
    const std::vector<LayoutPoint>& map = index_.points();
    float score = 0;
    int open = total_bound_;  // upper bound of the gain of the remaining points
    for (const BoundedPoint& candidate : candidates_) {
      const LayoutPoint& p = points_[candidate.point];
      const float x = pose.cosine * p.x - pose.sine * p.y + pose.x,
                  y = pose.sine * p.x + pose.cosine * p.y + pose.y;
      float gain = 0;
      for (const int j : index_.FindWithinReach(x, y)) {
        const float dx = map[j].x - x, dy = map[j].y - y, dz = map[j].z - p.z - pose.z;
        const float d2 = dx * dx + dy * dy + dz * dz;
        if (d2 >= inlier2_) continue;
        gain = std::max(gain,
                        (1 - d2 / inlier2_) * (map[j].label == p.label ? 1.f : kOtherLabelScore));
      }
      score += gain;
      open -= candidate.bound;
      if (open < NeededGain(score)) return 0;
    }
    return score;
  }

  // What has to come on top of a score to reach threshold_; a little less, for the sake of
  // rounding. [1/GainBound::kOne]
  int NeededGain(float score) const {
    constexpr float kRoundOff = 1e-3f;
    return static_cast<int>((threshold_ - score - kRoundOff) * GainBound::kOne) - 1;
  }

  // Raises the threshold to the share of the best score, and to the score of the last kept pose.
  void RaiseThreshold(float score) {
    constexpr int kNow = 256;  // interval of selecting the best ones
    threshold_ = std::max(threshold_, kShareOfBest * score);
    if (++proposed_ % kNow != 0 || cells_.size() <= capacity_) return;
    std::vector<float> scores;
    for (const auto& [cell, pose] : cells_) scores.push_back(pose.score);
    const auto last = scores.begin() + static_cast<std::ptrdiff_t>(capacity_) - 1;
    std::nth_element(scores.begin(), last, scores.end(), std::greater<>());
    threshold_ = std::max(threshold_, *last);
  }

  struct BoundedPoint {
    int point, bound;
  };
  const std::vector<LayoutPoint>& points_;
  const LayoutIndex& index_;
  std::vector<float> x_, y_;              // coordinates of the points, padded with zeros
  std::vector<std::uint8_t> bounds_;      // upper bounds of their gains
  std::vector<BoundedPoint> candidates_;  // of the current pose
  int total_bound_ = 0;                   // sum of these bounds
  GainBound bound_;
  float inlier2_, threshold_ = 0;  // smallest score that is still relevant
  std::size_t capacity_, proposed_ = 0, looked_at_ = 0;
  std::unordered_map<std::int64_t, CoarsePose> cells_;
};

// Aligns every selected local pair with every global pair of equal distance.
void ProposePairPoses(const std::vector<LayoutObject>& local,
                      const std::vector<LayoutPoint>& points, const LayoutIndex& index,
                      TopPoses& top_poses) {
  const std::vector<LayoutPoint>& map = index.points();
  const float tolerance = static_cast<float>(kPairNoiseM);
  for (const LocalPair& chosen : ChoosePairs(local, index)) {
    const ObjectPair& l = chosen.pair;
    const LayoutPoint &pa = points[l.a], &pb = points[l.b];
    for (const ObjectPair& g : index.pairs().Between(pa.label, pb.label, l.distance - kPairNoiseM,
                                                     l.distance + kPairNoiseM)) {
      if (std::abs(g.distance - l.distance) > tolerance) continue;
      if (map[g.a].label != pa.label || map[g.b].label != pb.label) continue;
      for (int flip = 0; flip < (pa.label == pb.label ? 2 : 1); ++flip) {
        const float sign = flip ? -1.f : 1.f;
        if (std::abs(sign * g.dz - l.dz) > tolerance) continue;
        const float c = sign * (g.dx * l.dx + g.dy * l.dy), s = sign * (g.dy * l.dx - g.dx * l.dy);
        const LayoutPoint &qa = map[flip ? g.b : g.a], &qb = map[flip ? g.a : g.b];
        const float mx = (pa.x + pb.x) / 2, my = (pa.y + pb.y) / 2;
        CoarsePose pose;
        pose.cosine = c;
        pose.sine = s;
        pose.x = (qa.x + qb.x) / 2 - (c * mx - s * my);
        pose.y = (qa.y + qb.y) / 2 - (s * mx + c * my);
        pose.z = (qa.z + qb.z) / 2 - (pa.z + pb.z) / 2;
        top_poses.Propose(pose);
      }
    }
  }
}

}  // namespace

bool IsBetter(const CoarsePose& a, const CoarsePose& b) {
  if (a.score != b.score) return a.score > b.score;
  if (a.x != b.x) return a.x < b.x;
  return a.y != b.y ? a.y < b.y : a.sine < b.sine;
}

void KeepBest(std::size_t most, std::vector<CoarsePose>& poses) {
  if (poses.size() <= most) return;
  std::nth_element(poses.begin(), poses.begin() + static_cast<std::ptrdiff_t>(most), poses.end(),
                   IsBetter);
  poses.resize(most);
}

CoarseSearch CoarsePoses(const std::vector<LayoutObject>& local, const Vec3& centre,
                         const LayoutIndex& index, const PoseSearchOptions& options) {
  std::vector<LayoutPoint> points;
  for (const LayoutObject& object : local) {
    const Eigen::Vector3f p = (object.position - centre).cast<float>();
    points.push_back({p.x(), p.y(), p.z(), object.label});
  }
  if (index.tiles() != nullptr) return LargeMapPoses(points, index, options);
  TopPoses top_poses(points, index, options);
  ProposePairPoses(local, points, index, top_poses);
  CoarseSearch found;
  found.best = top_poses.Best();
  found.looked_at = top_poses.looked_at();
  return found;
}

}  // namespace sslcd
