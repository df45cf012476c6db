// SPDX-License-Identifier: BSD-3-Clause
#include "ground/ground_patches.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace sslcd {
namespace {

/// Calls use(patch, scores) for each patch of the first view that the second view also shows,
/// including its surroundings. `scores` has the correlation in [-1, 1] for shifts of up to `search`
/// cells in each direction.
template <class Use>
void ForEachPatch(const TopView& from, const TopView& to, int half, int search, const Use& use) {
  const auto all_seen = [](const cv::Mat& seen) {
    return cv::countNonZero(seen) == seen.rows * seen.cols;
  };
  const int margin = half + search, side = 2 * half + 1;
  for (int row = margin; row < from.grey.rows - margin; row += half) {
    for (int column = margin; column < from.grey.cols - margin; column += half) {
      const cv::Rect patch(column - half, row - half, side, side);
      const cv::Rect around(column - margin, row - margin, side + 2 * search, side + 2 * search);
      if (!all_seen(from.seen(patch)) || !all_seen(to.seen(around))) continue;
      cv::Mat scores;
      cv::matchTemplate(to.grey(around), from.grey(patch), scores, cv::TM_CCOEFF_NORMED);
      use(patch, scores);
    }
  }
}

// The compared ground ahead of the first camera [m]. Few cameras see nearer than 2.5 m; beyond 14
// m, 3 cm are a seventh of an image row (focal length 700 px, height 1.2 m). Not tuned.
constexpr double kNear = 2.5, kLength = 11.5, kHalfWidth = 8;

/// The vertex of the parabola through three values, relative to the middle one.
double Top(double before, double here, double after) {
  return 0.5 * (before - after) / (before - 2 * here + after);
}

}  // namespace

Pose OnGround(const Pose& T) {
  const Vec3 ahead = T.so3() * Vec3(Vec3::UnitZ());
  return Pose::Trans(T.translation().x(), 0, T.translation().z()) *
         Pose::RotY(std::atan2(ahead.x(), ahead.z()));
}

GroundGrid GridOf(double cell) {
  return {-kHalfWidth, kNear, cell, static_cast<int>(2 * kHalfWidth / cell),
          static_cast<int>(kLength / cell)};
}

std::optional<Pose> FindMotion(const GroundView& a, const GroundView& b, const StereoCamera& camera,
                               const Pose& guess, double search_m) {
  constexpr double kCell = 0.06, kTurn = 0.01;  // steps of the search [m], [rad]; set by hand
  // [rad] heading error after object loops (docs/architecture.md, "How images of two passes are
  // aligned")
  constexpr double kSearchTurn = 0.03;
  // Half the width of a patch [cells], and smallest number of patches. Set by hand.
  constexpr int kHalf = 7, kFewest = 5;
  const GroundGrid grid = GridOf(kCell);
  const int search = static_cast<int>(std::ceil(search_m / kCell));
  const int turns = static_cast<int>(std::ceil(kSearchTurn / kTurn));
  const Pose to_middle = Pose::Trans(0, 0, kNear + 0.5 * kLength);
  const TopView from = SeeFromAbove(a.grey, camera.left, a.T_cam_ground, grid);
  std::optional<Pose> best;
  double highest = 0;
  for (int k = -turns; k <= turns; ++k) {
    const Pose turned = to_middle * Pose::RotY(k * kTurn) * to_middle.inverse() * guess;
    const TopView to = SeeFromAbove(b.grey, camera.left, b.T_cam_ground * turned.inverse(), grid);
    cv::Mat sum(2 * search + 1, 2 * search + 1, CV_32F, cv::Scalar(0));
    int count = 0;
    ForEachPatch(from, to, kHalf, search, [&](const cv::Rect&, const cv::Mat& scores) {
      sum += scores;
      ++count;
    });
    if (count < kFewest) continue;
    double score = 0;
    cv::Point at;
    cv::minMaxLoc(sum, nullptr, &score, nullptr, &at);
    if (score / count <= highest) continue;
    highest = score / count;
    best = Pose::Trans(-kCell * (at.x - search), 0, -kCell * (at.y - search)) * turned;
  }
  return best;
}

std::vector<GroundPair> MatchPatches(const TopView& from, const TopView& to, const GroundGrid& grid,
                                     int search, int& tried) {
  constexpr int kHalf = 20;          // [cells] half the width of a patch; set by hand
  constexpr double kMinScore = 0.5;  // correlation of a match; set by hand
  std::vector<GroundPair> pairs;
  ForEachPatch(from, to, kHalf, search, [&](const cv::Rect& patch, const cv::Mat& scores) {
    ++tried;
    double score = 0;
    cv::Point at;
    cv::minMaxLoc(scores, nullptr, &score, nullptr, &at);
    const cv::Rect inner(1, 1, scores.cols - 2, scores.rows - 2);
    if (score < kMinScore || !inner.contains(at)) return;
    const auto near = [&](int x, int y) {
      return static_cast<double>(scores.at<float>(at.y + y, at.x + x));
    };
    const double x = at.x - search + Top(near(-1, 0), near(0, 0), near(1, 0));
    const double y = at.y - search + Top(near(0, -1), near(0, 0), near(0, 1));
    const int column = patch.x + kHalf, row = patch.y + kHalf;
    pairs.push_back({grid.At(column, row), grid.At(column + x, row + y)});
  });
  return pairs;
}

Pose FitMotion(std::vector<GroundPair>& pairs) {
  // Scale of the Cauchy weights, and largest residual of a consistent pair. Set by hand. [m]
  constexpr double kScale = 0.02, kAgree = 0.05;
  constexpr int kRounds = 10;
  Pose motion;
  std::vector<double> weights(pairs.size(), 1);
  for (int round = 0; round < kRounds; ++round) {
    double sum = 0, sine = 0, cosine = 0;
    Vec3 middle_a(0, 0, 0), middle_b(0, 0, 0);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      sum += weights[i];
      middle_a += weights[i] * pairs[i].in_a;
      middle_b += weights[i] * pairs[i].in_b;
    }
    middle_a /= sum;
    middle_b /= sum;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const Vec3 p = pairs[i].in_a - middle_a, q = pairs[i].in_b - middle_b;
      cosine += weights[i] * q.dot(p);
      sine += weights[i] * q.cross(p).y();
    }
    motion = Pose::Trans(middle_a) * Pose::RotY(std::atan2(sine, cosine)) * Pose::Trans(-middle_b);
    for (std::size_t i = 0; i < pairs.size(); ++i)
      weights[i] = 1 / (1 + std::pow((motion * pairs[i].in_b - pairs[i].in_a).norm() / kScale, 2));
  }
  const auto differs = [&](const GroundPair& pair) {
    return !((motion * pair.in_b - pair.in_a).norm() < kAgree);
  };
  pairs.erase(std::remove_if(pairs.begin(), pairs.end(), differs), pairs.end());
  return motion;
}

}  // namespace sslcd
