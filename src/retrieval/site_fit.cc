// SPDX-License-Identifier: BSD-3-Clause
#include "retrieval/site_fit.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace sslcd {
namespace {

// All set by hand on generated sites (docs/scale.md).
constexpr float kCell = 4;               // of the grid [m]
constexpr float kGates[] = {4, 2.5, 2};  // largest distance of a match, by step [m]
constexpr float kMatchGate = 2;
constexpr float kSigma = 0.7f;       // of a matched object, each axis [m]
constexpr float kSeen = 0.75f;       // share of objects that both have
constexpr float kUnseen = -0.7f;     // for an object of the site amid the stretch, without match
constexpr float kAmid = 4;           // as far from an object of the stretch [m]
constexpr float kMostScale = 0.06f;  // of the odometry's error
constexpr int kMostCells = 512;      // of the grid, each axis

// The objects of a site near the stretch, by cells.
class Window {
 public:
  Window(const Span<SitePoint>& site, const FlatPose& pose, float reach)
      : side_(1 + static_cast<int>(std::min(2 * reach / kCell, kMostCells - 1.f))),
        left_(pose.x - reach),
        bottom_(pose.y - reach),
        start_(static_cast<std::size_t>(side_) * side_ + 1, 0) {
    const auto before = [](const SitePoint& point, float x) { return point.x < x; };
    const SitePoint* const first = std::lower_bound(site.first, site.last, left_, before);
    const SitePoint* const last = std::lower_bound(first, site.last, left_ + 2 * reach, before);
    for (const SitePoint* point = first; point != last; ++point)
      if (const int cell = CellOf(point->x, point->y); cell >= 0) ++start_[cell + 1];
    for (std::size_t i = 1; i < start_.size(); ++i) {
      occupied_ += start_[i] > 0;
      start_[i] += start_[i - 1];
    }
    points_.resize(start_.back());
    std::vector<int> next(start_.begin(), start_.end() - 1);
    for (const SitePoint* point = first; point != last; ++point)
      if (const int cell = CellOf(point->x, point->y); cell >= 0) points_[next[cell]++] = *point;
  }

  const std::vector<SitePoint>& points() const { return points_; }

  /// Objects a square metre, of those with this label, where there are objects at all.
  float Density(int label) const {
    const auto same = std::count_if(points_.begin(), points_.end(),
                                    [&](const SitePoint& point) { return point.label == label; });
    // an object is taken to have about nine cells around it, which overlap
    const float area = kCell * kCell * 3 * static_cast<float>(std::max(occupied_, 1));
    return (static_cast<float>(same) + 0.5f) / area;
  }

  /// Calls visit(index) for the objects in the cells around a point, all within kCell among them.
  template <class Visitor>
  void Visit(float x, float y, Visitor&& visit) const {
    const int column = ColumnOf(x - left_), row = ColumnOf(y - bottom_);
    for (int r = std::max(row - 1, 0); r <= std::min(row + 1, side_ - 1); ++r) {
      const int from = std::max(column - 1, 0), to = std::min(column + 1, side_ - 1);
      if (from > to) return;
      for (int i = start_[r * side_ + from]; i < start_[r * side_ + to + 1]; ++i) visit(i);
    }
  }

 private:
  // -2: far outside, or not a number.
  static int ColumnOf(float metres) {
    const float cells = std::floor(metres / kCell);
    return cells >= -2 ? static_cast<int>(std::min(cells, kMostCells + 2.f)) : -2;
  }
  int CellOf(float x, float y) const {
    const int column = ColumnOf(x - left_), row = ColumnOf(y - bottom_);
    return column < 0 || row < 0 || column >= side_ || row >= side_ ? -1 : row * side_ + column;
  }

  int side_;
  float left_, bottom_;
  std::vector<int> start_;  // of each cell in points_
  int occupied_ = 0;
  std::vector<SitePoint> points_;
};

struct Match {
  int point = -1;     // of the window; -1: none
  float squared = 0;  // distance [m^2]
};

// A pose with a scale.
struct Similarity {
  float c = 1, s = 0, x = 0, y = 0;
  float AtX(const SitePoint& p) const { return c * p.x - s * p.y + x; }
  float AtY(const SitePoint& p) const { return s * p.x + c * p.y + y; }
};

// The nearest object of the same label for each object of the stretch, one to one.
std::vector<Match> FindMatches(const std::vector<SitePoint>& points, const Window& window,
                               const Similarity& at, float gate) {
  std::vector<Match> matches(points.size());
  std::vector<int> owner(window.points().size(), -1);
  for (std::size_t i = 0; i < points.size(); ++i) {
    Match& best = matches[i];
    best.squared = gate * gate;
    const float x = at.AtX(points[i]), y = at.AtY(points[i]);
    window.Visit(x, y, [&](int j) {
      const SitePoint& other = window.points()[j];
      const float d2 = (other.x - x) * (other.x - x) + (other.y - y) * (other.y - y);
      if (other.label == points[i].label && d2 < best.squared) best = {j, d2};
    });
    if (best.point < 0) continue;
    int& holder = owner[best.point];
    if (holder >= 0 && matches[holder].squared <= best.squared) {
      best.point = -1;
      continue;
    }
    if (holder >= 0) matches[holder].point = -1;
    holder = static_cast<int>(i);
  }
  return matches;
}

// Least squares over the matches (Umeyama 1991, in the plane), with a bounded scale.
Similarity Align(const std::vector<SitePoint>& points, const Window& window,
                 const std::vector<Match>& matches, const Similarity& before) {
  float n = 0, px = 0, py = 0, qx = 0, qy = 0;
  const auto each = [&](const auto& use) {
    for (std::size_t i = 0; i < points.size(); ++i)
      if (matches[i].point >= 0) use(points[i], window.points()[matches[i].point]);
  };
  each([&](const SitePoint& p, const SitePoint& q) {
    n += 1, px += p.x, py += p.y, qx += q.x, qy += q.y;
  });
  if (n < 3) return before;
  px /= n, py /= n, qx /= n, qy /= n;
  float dot = 0, cross = 0, spread = 0;
  each([&](const SitePoint& p, const SitePoint& q) {
    const float ax = p.x - px, ay = p.y - py, bx = q.x - qx, by = q.y - qy;
    dot += ax * bx + ay * by;
    cross += ax * by - ay * bx;
    spread += ax * ax + ay * ay;
  });
  const float norm = std::hypot(dot, cross);
  if (!(norm > 0) || !(spread > 0)) return before;
  const float scale = std::clamp(norm / spread, 1 - kMostScale, 1 + kMostScale);
  Similarity at{scale * dot / norm, scale * cross / norm, 0, 0};
  at.x = qx - (at.c * px - at.s * py);
  at.y = qy - (at.s * px + at.c * py);
  return at;
}

float Score(const std::vector<SitePoint>& points, const Window& window,
            const std::vector<Match>& matches, const Similarity& at) {
  const float peak = std::log(kSeen / (2 * static_cast<float>(M_PI) * kSigma * kSigma));
  const float missed = std::log(1 - kSeen);
  std::vector<char> amid(window.points().size(), 0);
  std::map<int, float> chance;  // log density by label
  for (const SitePoint& point : points) chance.insert({point.label, 0});
  for (auto& [label, density] : chance) density = std::log(window.Density(label));
  float score = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const float x = at.AtX(points[i]), y = at.AtY(points[i]);
    window.Visit(x, y, [&](int j) {
      const SitePoint& other = window.points()[j];
      const float d2 = (other.x - x) * (other.x - x) + (other.y - y) * (other.y - y);
      if (d2 < kAmid * kAmid && amid[j] == 0) amid[j] = 1;
    });
    float gain = missed;
    if (matches[i].point >= 0) {
      gain = std::max(
          gain, peak - matches[i].squared / (2 * kSigma * kSigma) - chance.at(points[i].label));
      amid[matches[i].point] = 2;
    }
    score += gain;
  }
  return score + kUnseen * static_cast<float>(std::count(amid.begin(), amid.end(), 1));
}

}  // namespace

SiteFit FitSite(const std::vector<SitePoint>& points, const Span<SitePoint>& site,
                const FlatPose& start) {
  float reach = 0;
  for (const SitePoint& point : points) reach = std::max(reach, std::hypot(point.x, point.y));
  // a false object far away leaves the grid around the others
  reach = std::min((1 + kMostScale) * reach + 2 * kGates[0], kCell * kMostCells / 2);
  const Window window(site, start, reach);
  Similarity at{std::cos(start.yaw), std::sin(start.yaw), start.x, start.y};
  for (const float gate : kGates)
    at = Align(points, window, FindMatches(points, window, at, gate), at);
  const std::vector<Match> matches = FindMatches(points, window, at, kMatchGate);
  SiteFit fit;
  fit.pose = {std::atan2(at.s, at.c), at.x, at.y};
  fit.score = Score(points, window, matches, at);
  for (const Match& match : matches) fit.matches += match.point >= 0;
  return fit;
}

}  // namespace sslcd
