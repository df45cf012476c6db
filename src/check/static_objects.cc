// SPDX-License-Identifier: BSD-3-Clause
#include "check/static_objects.h"

#include <algorithm>
#include <limits>
#include <map>

#include "core/median.h"

namespace sslcd::check {
namespace {

constexpr int kMostPairs = 300, kLongestLag = 32, kBlocks = 20;
constexpr double kLeastStill = 0.5;  // share of the cap by which objects move in the camera
constexpr double kMostCap = 3;       // [m]
constexpr double kVote = 0.05;       // of the cap: a block whose scatter changes by more votes
constexpr double kNear = 0.5;        // share of the detections, the nearest: their noise is least

void KeepNearest(std::vector<std::vector<Sight>>& sights) {
  std::vector<double> ranges;
  for (const auto& frame : sights)
    for (const Sight& sight : frame) ranges.push_back(sight.position.norm());
  if (ranges.empty()) return;
  const auto limit =
      ranges.begin() + static_cast<std::ptrdiff_t>(kNear * static_cast<double>(ranges.size()));
  std::nth_element(ranges.begin(), limit, ranges.end());
  for (auto& frame : sights)
    frame.erase(std::remove_if(frame.begin(), frame.end(),
                               [&](const Sight& sight) { return sight.position.norm() > *limit; }),
                frame.end());
}

std::vector<std::vector<Sight>> SightsByFrame(const Sequence& sequence) {
  std::map<std::string, int> labels;
  std::vector<std::vector<Sight>> sights;
  for (const auto& rows : RowsByFrame(sequence)) {
    sights.emplace_back();
    for (const Row* row : rows) {
      const int label =
          labels.emplace(row->detection.label, static_cast<int>(labels.size())).first->second;
      sights.back().push_back({label, row->detection.T_cam_object.translation(), row});
    }
  }
  return sights;
}

bool ShareALabel(const std::vector<Sight>& a, const std::vector<Sight>& b) {
  return std::any_of(a.begin(), a.end(), [&](const Sight& one) {
    return std::any_of(b.begin(), b.end(),
                       [&](const Sight& other) { return other.label == one.label; });
  });
}

double NearestDistance(const Sight& one, const Vec3& place, const std::vector<Sight>& others) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Sight& other : others)
    if (other.label == one.label && &other != &one)
      nearest = std::min(nearest, (other.position - place).norm());
  return nearest;
}

/// Adds nothing where the other frame has no object of the label.
void AddNearest(const Sight& one, const Vec3& place, const std::vector<Sight>& others,
                std::vector<double>& distances) {
  const double distance = NearestDistance(one, place, others);
  if (distance < std::numeric_limits<double>::infinity()) distances.push_back(distance);
}

double MeanShare(const std::vector<double>& distances, double cap_m) {
  double total = 0;
  for (const double distance : distances) total += std::min(distance, cap_m) / cap_m;
  return distances.empty() ? 1 : total / static_cast<double>(distances.size());
}

double CapOf(const std::vector<std::vector<Sight>>& sights) {
  std::vector<double> distances;
  for (const auto& frame : sights)
    for (const Sight& one : frame)
      if (const double d = NearestDistance(one, one.position, frame); d < 1e9)
        distances.push_back(d);
  return distances.empty() ? kMostCap : std::min(kMostCap, 0.5 * Median(std::move(distances)));
}

std::vector<FramePair> PairsOf(const Sequence& sequence,
                               const std::vector<std::vector<Sight>>& sights, int lag, int most) {
  std::vector<int> firsts, failed(sights.size() + 1, 0);
  for (std::size_t i = 0; i < sights.size(); ++i)
    failed[i + 1] = failed[i] + (sequence.steps[i] && sequence.steps[i]->lost ? 1 : 0);
  for (int i = 0; i + lag < sequence.frames(); ++i)
    if (failed[i + lag + 1] == failed[i + 1] && ShareALabel(sights[i], sights[i + lag]))
      firsts.push_back(i);
  std::vector<FramePair> pairs;
  const double stride = std::max(1., static_cast<double>(firsts.size()) / most);
  for (double at = 0; at < static_cast<double>(firsts.size()); at += stride) {
    const int first = firsts[static_cast<std::size_t>(at)];
    pairs.push_back({first, first + lag, sights[first], sights[first + lag]});
  }
  return pairs;
}

}  // namespace

Motion MotionBetween(const Pose& T_world_first, const Pose& T_world_second) {
  const Pose motion = T_world_second.inverse() * T_world_first;
  return {motion.so3().matrix(), motion.translation()};
}

MotionFunction MotionsOf(const std::vector<Pose>& poses,
                         const std::function<Pose(const Pose&)>& correct) {
  return [&poses, correct](int first, int second) {
    const Pose &a = poses[static_cast<std::size_t>(first)],
               &b = poses[static_cast<std::size_t>(second)];
    return correct ? MotionBetween(correct(a), correct(b)) : MotionBetween(a, b);
  };
}

std::vector<FramePair> PairsAtLag(const Sequence& sequence, int lag, int most) {
  return PairsOf(sequence, SightsByFrame(sequence), lag, most);
}

Scatter ScatterOf(const std::vector<FramePair>& pairs, const MotionFunction& motions,
                  double cap_m) {
  Scatter scatter;
  double sum = 0;
  std::vector<double> distances;
  for (const FramePair& pair : pairs) {
    const Motion motion = motions(pair.first, pair.second);
    const Eigen::Matrix3d back = motion.R.transpose();
    // forward loses the objects that leave the image, backward those that enter it
    std::vector<double> ahead, behind;
    for (const Sight& sight : pair.before)
      AddNearest(sight, motion.R * sight.position + motion.t, pair.after, ahead);
    for (const Sight& sight : pair.after)
      AddNearest(sight, back * (sight.position - motion.t), pair.before, behind);
    const double share_ahead = MeanShare(ahead, cap_m), share_behind = MeanShare(behind, cap_m);
    const std::vector<double>& used = share_behind < share_ahead ? behind : ahead;
    scatter.by_pair.push_back(std::min(share_behind, share_ahead));
    sum += scatter.by_pair.back() * static_cast<double>(used.size());
    distances.insert(distances.end(), used.begin(), used.end());
  }
  if (distances.empty()) return scatter;
  scatter.objects = static_cast<int>(distances.size());
  scatter.share = sum / scatter.objects;
  scatter.median_m = Median(std::move(distances));
  return scatter;
}

BlockVotes CompareBlocks(const Scatter& given, const Scatter& other) {
  const std::size_t pairs = given.by_pair.size();
  BlockVotes votes;
  for (std::size_t block = 0; block < kBlocks; ++block) {
    const std::size_t from = block * pairs / kBlocks, to = (block + 1) * pairs / kBlocks;
    double gain = 0;
    for (std::size_t i = from; i < to; ++i) gain += given.by_pair[i] - other.by_pair[i];
    gain /= std::max(1., static_cast<double>(to - from));
    votes.better += gain > kVote ? 1 : 0;
    votes.worse += gain < -kVote ? 1 : 0;
  }
  return votes;
}

std::optional<StaticObjects> FindStaticObjects(const Sequence& sequence) {
  auto sights = SightsByFrame(sequence);
  KeepNearest(sights);
  StaticObjects found;
  found.cap_m = CapOf(sights);
  if (!(found.cap_m > 0)) return std::nullopt;
  for (found.lag = 1; found.lag <= kLongestLag; found.lag *= 2) {
    found.pairs = PairsOf(sequence, sights, found.lag, kMostPairs);
    found.still = ScatterOf(
        found.pairs, [](int, int) { return Motion{}; }, found.cap_m);
    found.objects = found.still.objects;
    if (found.objects < kLeastObjects || static_cast<int>(found.pairs.size()) < kLeastPairs)
      return std::nullopt;
    if (found.still.share >= kLeastStill) return found;
  }
  return std::nullopt;
}

}  // namespace sslcd::check
