// SPDX-License-Identifier: BSD-3-Clause
#include "retrieval/find_site.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <numeric>
#include <string>
#include <utility>

#include "core/median.h"
#include "retrieval/constellation_key.h"
#include "retrieval/pose_votes.h"
#include "retrieval/site_fit.h"

namespace sslcd {
namespace {

// All set by hand on generated sites (docs/scale.md).
// Probes beyond a cost of 2.5 fill kMostProbes before the last constellations of a dense stretch
// have any.
constexpr float kMostCost = 2.5f;                  // of a probe [nats]
constexpr std::size_t kMostProbes = 60000;         // cells that are looked up
constexpr std::size_t kMostVisits = 800000;        // entries that are read
constexpr std::size_t kMostPoses = 1000;           // poses that are aligned with some objects
constexpr std::size_t kSomeObjects = 20;           // the nearest ones to the middle
constexpr std::size_t kMostFits = 60;              // poses that are aligned with all objects
constexpr int kMostSteps = 10 * kDifferenceSteps;  // difference of a vote's constellation
constexpr std::size_t kAhead = 16;                 // lookups that are fetched from memory ahead

// Objects beyond are no objects, and constellations so far from the middle belong to no stretch.
// [m]
constexpr double kFarthestObject = 1e8;
constexpr float kFarFromMiddle = 1e5;

struct Stretch {
  std::vector<SitePoint> points;  // from the middle
  double x = 0, y = 0;            // the middle
};

std::map<std::string, std::uint16_t> LabelNumbers(const SiteFile& file) {
  std::map<std::string, std::uint16_t> numbers;
  for (std::uint64_t i = 0; i < file.header().labels; ++i) {
    const auto number = static_cast<std::uint16_t>(i);
    numbers.emplace(file.label(number), number);
  }
  return numbers;
}

// The median along one axis, which an object far away does not move; 0 without objects.
double MiddleOf(const std::vector<std::pair<const SiteObject*, std::uint16_t>>& objects,
                double SiteObject::*axis) {
  if (objects.empty()) return 0;
  std::vector<double> values;
  values.reserve(objects.size());
  for (const auto& [object, label] : objects) values.push_back(object->*axis);
  return Median(std::move(values));
}

Stretch StretchOf(const SiteFile& file, const std::vector<SiteObject>& objects) {
  const std::map<std::string, std::uint16_t> numbers = LabelNumbers(file);
  std::vector<std::pair<const SiteObject*, std::uint16_t>> known;
  for (const SiteObject& object : objects) {
    const auto label = numbers.find(object.label);
    const bool placed =
        std::abs(object.x) < kFarthestObject && std::abs(object.y) < kFarthestObject;
    if (label != numbers.end() && placed) known.emplace_back(&object, label->second);
  }
  Stretch stretch;
  stretch.x = MiddleOf(known, &SiteObject::x), stretch.y = MiddleOf(known, &SiteObject::y);
  for (const auto& [object, label] : known)
    stretch.points.push_back({static_cast<float>(object->x - stretch.x),
                              static_cast<float>(object->y - stretch.y), label, 0});
  return stretch;
}

// A cell of the index to be read.
struct Lookup {
  Span<SiteEntry> bucket;
  std::uint32_t constellation = 0;
  std::uint16_t offsets = 0;
  float weight = 0;  // of a vote [nats]
  float price = 0;   // entries to read for a right one, up to a factor
};

// A price as a number of steps of 1/8 in its logarithm to the base of 2, nearly.
int StepsOf(float price) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, &price, sizeof bits);  // exponent, then the leading bits of the mantissa
  return static_cast<int>(bits >> 20);
}

// Leaves those that are most likely to hold few entries and the right one among them.
void KeepCheapest(std::vector<Lookup>& lookups) {
  std::vector<std::size_t> entries(1 << 11, 0);  // by price
  for (const Lookup& lookup : lookups) entries[StepsOf(lookup.price)] += lookup.bucket.size();
  int most = 0;
  for (std::size_t sum = 0; most < static_cast<int>(entries.size()); ++most)
    if ((sum += entries[most]) > kMostVisits) break;
  lookups.erase(std::remove_if(lookups.begin(), lookups.end(),
                               [&](const Lookup& one) { return StepsOf(one.price) >= most; }),
                lookups.end());
}

// The cells around the constellations.
std::vector<Lookup> Lookups(const SiteFile& file, const std::vector<SearchedConstellation>& all) {
  std::vector<Probe> probes;
  std::vector<std::uint32_t> of;  // the constellation of each probe
  for (std::size_t i = 0; i < all.size() && probes.size() < kMostProbes; ++i) {
    all[i].AppendProbes(kMostCost, probes);
    of.resize(probes.size(), static_cast<std::uint32_t>(i));
  }
  std::vector<Lookup> lookups;
  lookups.reserve(probes.size());
  for (std::size_t i = 0; i < probes.size(); ++i) {
    if (i + kAhead < probes.size()) file.PrefetchBucket(probes[i + kAhead].cell);
    Lookup lookup{file.bucket(probes[i].cell), of[i], probes[i].offsets, 0, 0};
    if (lookup.bucket.size() == 0) continue;
    const auto entries = static_cast<float>(lookup.bucket.size());
    const float likely = std::exp(-probes[i].cost);
    lookup.price = entries / likely;
    lookup.weight = std::log(static_cast<float>(file.header().points) / entries);
    lookups.push_back(lookup);
  }
  KeepCheapest(lookups);
  return lookups;
}

// Sines of all headings that votes tell apart.
class Headings {
 public:
  Headings() {
    for (int i = 0; i < kSteps; ++i) sine_[i] = static_cast<float>(std::sin(2 * M_PI * i / kSteps));
  }

  // `yaw`: of the constellation of the stretch, as SiteEntry::yaw.
  PoseVote VoteOf(const SiteEntry& entry, const Constellation& one, std::uint8_t yaw,
                  float weight) const {
    const auto step = static_cast<std::uint8_t>(entry.yaw - yaw);
    const float s = sine_[step], c = sine_[static_cast<std::uint8_t>(step + kSteps / 4)];
    return {entry.site,
            {static_cast<float>(step) * static_cast<float>(2 * M_PI / kSteps),
             static_cast<float>(entry.x) - (c * one.x - s * one.y),
             static_cast<float>(entry.y) - (s * one.x + c * one.y)},
            weight};
  }

 private:
  static constexpr int kSteps = 256;
  std::array<float, kSteps> sine_{};
};

std::vector<PoseVote> LikelyPoses(const SiteFile& file, const std::vector<SitePoint>& points,
                                  PoseVotes& votes) {
  std::vector<SearchedConstellation> all;
  VisitConstellations(points, NearestNeighbours(points), [&](const Constellation& one) {
    if (std::hypot(one.x, one.y) < kFarFromMiddle) all.emplace_back(one);
  });
  const Headings headings;
  votes.Clear();
  const std::vector<Lookup> lookups = Lookups(file, all);
  for (std::size_t i = 0; i < lookups.size(); ++i) {
    if (i + kAhead < lookups.size()) __builtin_prefetch(lookups[i + kAhead].bucket.first);
    const Lookup& lookup = lookups[i];
    const SearchedConstellation& one = all[lookup.constellation];
    const std::uint8_t yaw = StepsOfTurn(one.constellation().axis_x, one.constellation().axis_y);
    for (const SiteEntry& entry : lookup.bucket) {
      const int steps = one.Difference(lookup.offsets, entry.inside, kMostSteps);
      const float weight = lookup.weight - static_cast<float>(steps) / (2 * kDifferenceSteps);
      if (steps <= kMostSteps && weight > 0 && entry.site < file.sites())
        votes.Add(headings.VoteOf(entry, one.constellation(), yaw, weight));
    }
  }
  return votes.Best(kMostPoses);
}

// The objects nearest to the middle. Errors of heading and scale hardly move them, and few objects
// are quickly aligned.
std::vector<SitePoint> AmidOf(std::vector<SitePoint> points) {
  const auto nearer = [](const SitePoint& a, const SitePoint& b) {
    return a.x * a.x + a.y * a.y < b.x * b.x + b.y * b.y;
  };
  std::stable_sort(points.begin(), points.end(), nearer);
  points.resize(std::min(points.size(), kSomeObjects));
  return points;
}

}  // namespace

std::vector<std::size_t> HighestScores(const std::vector<float>& scores, std::size_t most) {
  std::vector<std::size_t> best(scores.size());
  std::iota(best.begin(), best.end(), std::size_t{0});
  std::stable_sort(best.begin(), best.end(),
                   [&](std::size_t a, std::size_t b) { return scores[a] > scores[b]; });
  best.resize(std::min(best.size(), most));
  std::sort(best.begin(), best.end());
  return best;
}

namespace {

// The poses that fit best to the objects amid the stretch, in the order of their votes.
std::vector<PoseVote> BestAmid(const SiteFile& file, const std::vector<SitePoint>& points,
                               const std::vector<PoseVote>& poses) {
  if (poses.size() <= kMostFits) return poses;
  const std::vector<SitePoint> amid = AmidOf(points);
  std::vector<float> scores;
  for (const PoseVote& vote : poses)
    scores.push_back(FitSite(amid, file.points(vote.site), vote.pose).score);
  std::vector<PoseVote> best;
  for (const std::size_t i : HighestScores(scores, kMostFits)) best.push_back(poses[i]);
  return best;
}

}  // namespace

std::vector<SiteCandidate> FindSites(const SiteFile& file, const std::vector<SiteObject>& objects,
                                     int most, PoseVotes& votes) {
  const Stretch stretch = StretchOf(file, objects);
  std::map<std::uint32_t, SiteFit> fits;  // the best of each site
  const std::vector<PoseVote> likely = LikelyPoses(file, stretch.points, votes);
  for (const PoseVote& vote : BestAmid(file, stretch.points, likely)) {
    const SiteFit fit = FitSite(stretch.points, file.points(vote.site), vote.pose);
    const auto [known, fresh] = fits.insert({vote.site, fit});
    if (!fresh && fit.score > known->second.score) known->second = fit;
  }
  std::vector<SiteCandidate> candidates;
  for (const auto& [site, fit] : fits) {
    if (!(fit.score > 0)) continue;
    SiteCandidate one;
    one.site = static_cast<int>(site);
    one.score = fit.score;
    one.matches = fit.matches;
    one.yaw = fit.pose.yaw;
    const double c = std::cos(one.yaw), s = std::sin(one.yaw);
    one.x = file.site(site).x + fit.pose.x - (c * stretch.x - s * stretch.y);
    one.y = file.site(site).y + fit.pose.y - (s * stretch.x + c * stretch.y);
    candidates.push_back(one);
  }
  std::stable_sort(
      candidates.begin(), candidates.end(),
      [](const SiteCandidate& a, const SiteCandidate& b) { return a.score > b.score; });
  candidates.resize(std::min(candidates.size(), static_cast<std::size_t>(std::max(most, 0))));
  for (SiteCandidate& one : candidates) one.name = file.name(static_cast<std::uint32_t>(one.site));
  return candidates;
}

}  // namespace sslcd
