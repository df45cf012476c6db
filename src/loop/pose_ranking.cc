// SPDX-License-Identifier: BSD-3-Clause
#include "loop/pose_ranking.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/math.h"
#include "loop/layout_likelihood.h"
#include "loop/raster_search.h"
#include "loop/view_hull.h"

namespace sslcd {
namespace {

// All set by hand (docs/notes, city).
constexpr float kMatchGate = 1.8f;   // largest distance of objects that match [m]
constexpr std::size_t kPerKept = 5;  // poses whose view is counted, per pose that is kept
constexpr int kRounds = 2;           // alignments of these

class Ranking {
 public:
  Ranking(const std::vector<LayoutPoint>& points, const LayoutIndex& index)
      : points_(points), index_(index), view_(AsObjects(points)) {
    for (const LayoutPoint& p : points) gain_.push_back(MatchGain(p.label, index));
  }

  /// Aligns the pose with its matches. The score is that of the aligned pose with these matches.
  int Align(CoarsePose& pose) const {
    const std::vector<LayoutPoint>& map = index_.points();
    int n = 0;
    float gains = 0, px = 0, py = 0, qx = 0, qy = 0, dz = 0;
    float dot = 0, cross = 0, squares = 0;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const LayoutPoint& p = points_[i];
      const float rx = pose.cosine * p.x - pose.sine * p.y,
                  ry = pose.sine * p.x + pose.cosine * p.y;
      const float x = rx + pose.x, y = ry + pose.y;
      float nearest = kMatchGate * kMatchGate;
      int match = -1;
      for (const int j : index_.FindWithinReach(x, y)) {
        if (map[j].label != p.label) continue;
        const float d2 = (map[j].x - x) * (map[j].x - x) + (map[j].y - y) * (map[j].y - y);
        if (d2 >= nearest) continue;
        nearest = d2;
        match = j;
      }
      if (match < 0) continue;
      ++n;
      gains += gain_[i];
      const float tx = map[match].x - pose.x, ty = map[match].y - pose.y;
      px += rx;
      py += ry;
      qx += tx;
      qy += ty;
      dz += map[match].z - p.z;
      dot += rx * tx + ry * ty;
      cross += rx * ty - ry * tx;
      squares += rx * rx + ry * ry + tx * tx + ty * ty;
    }
    if (n < 2) {
      pose.score = -1e9f;
      return n;
    }
    const float count = static_cast<float>(n);
    dot -= (px * qx + py * qy) / count;
    cross -= (px * qy - py * qx) / count;
    squares -= (px * px + py * py + qx * qx + qy * qy) / count;
    const float norm = std::sqrt(dot * dot + cross * cross);
    if (norm > 0) {
      const float c = dot / norm, s = cross / norm;
      pose.x += (qx - (c * px - s * py)) / count;
      pose.y += (qy - (s * px + c * py)) / count;
      const float cosine = c * pose.cosine - s * pose.sine;
      pose.sine = s * pose.cosine + c * pose.sine;
      pose.cosine = cosine;
    }
    pose.z = dz / count;
    const float error = std::max(0.f, squares - 2 * norm);  // sum of d^2 after the alignment
    pose.score = -1e9f;
    for (const double place_sigma : kPlaceSigmas) {
      const float sigma = static_cast<float>(place_sigma);
      pose.score =
          std::max(pose.score, gains - 2 * count * std::log(sigma) - error / (2 * sigma * sigma));
    }
    return n;
  }

  /// Adds the evidence of the objects that have no match.
  void CountUnmatched(CoarsePose& pose, int matches) const {
    const YawShift shift{std::atan2(pose.sine, pose.cosine), Vec3(pose.x, pose.y, 0)};
    const Eigen::AlignedBox2d box = view_.BoxUnder(shift);
    int in_view = 0;
    index_.VisitBox(box.min(), box.max(), [&](int j) {
      const float dx = index_.points()[j].x - pose.x, dy = index_.points()[j].y - pose.y;
      in_view +=
          view_.Contains(pose.cosine * dx + pose.sine * dy, -pose.sine * dx + pose.cosine * dy);
    });
    const LayoutLikelihoodOptions defaults;
    const double all = static_cast<double>(points_.size());
    pose.score += static_cast<float>(
        LogBetaBinomial(matches, all - matches, defaults.mapped_prior, defaults.unmapped_prior) +
        LogBetaBinomial(matches, std::max(0, in_view - matches), defaults.seen_prior,
                        defaults.unseen_prior));
  }

 private:
  static std::vector<LayoutObject> AsObjects(const std::vector<LayoutPoint>& points) {
    std::vector<LayoutObject> objects(points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
      objects[i].position = Vec3(points[i].x, points[i].y, points[i].z);
    return objects;
  }

  const std::vector<LayoutPoint>& points_;
  const LayoutIndex& index_;
  ViewHull view_;
  std::vector<float> gain_;  // MatchGain of each local object
};

// Log of the sum of exp(score), if each pose counts `times` times.
double LogSumOfScores(const std::vector<double>& scores, double times = 1) {
  if (scores.empty()) return -std::numeric_limits<double>::infinity();
  return LogSumExp(scores) + std::log(times);
}

// Splits the poses into the best distinct ones and the others. Poses that are nearly the same as a
// better one are neither.
struct Split {
  std::vector<CoarsePose> best;
  std::vector<double> best_scores, other_scores;

  Split(const std::vector<CoarsePose>& sorted, std::size_t most) {
    constexpr float kSame = 1.f, kSameCosine = 0.995f;  // [m], of 6 degrees
    for (const CoarsePose& pose : sorted) {
      const bool known = std::any_of(best.begin(), best.end(), [&](const CoarsePose& other) {
        return std::abs(pose.x - other.x) < kSame && std::abs(pose.y - other.y) < kSame &&
               pose.cosine * other.cosine + pose.sine * other.sine > kSameCosine;
      });
      if (known) continue;
      if (best.size() == most) {
        other_scores.push_back(pose.score);
        continue;
      }
      best.push_back(pose);
      best_scores.push_back(pose.score);
    }
  }
};

}  // namespace

CoarseSearch RankPoses(std::vector<CoarsePose> poses, const std::vector<LayoutPoint>& points,
                       const LayoutIndex& index, const PoseSearchOptions& options) {
  CoarseSearch found;
  found.looked_at = poses.size();
  if (poses.empty()) return found;
  const Ranking ranking(points, index);
  for (CoarsePose& pose : poses) ranking.Align(pose);
  const std::size_t keep = options.refine;
  KeepBest(kPerKept * keep, poses);
  for (CoarsePose& pose : poses) {
    int matches = 0;
    for (int round = 0; round < kRounds; ++round) matches = ranking.Align(pose);
    ranking.CountUnmatched(pose, matches);
  }
  std::sort(poses.begin(), poses.end(), IsBetter);
  Split split(poses, keep);
  const double median = poses[poses.size() / 2].score;
  std::vector<double> left_out = {LogSumOfScores(split.other_scores)};
  if (found.looked_at > poses.size())
    left_out.push_back(
        LogSumOfScores({median}, static_cast<double>(found.looked_at - poses.size())));
  found.left_out = LogSumExp(left_out) - LogSumExp(split.best_scores);
  found.best = std::move(split.best);
  return found;
}

}  // namespace sslcd
