// SPDX-License-Identifier: BSD-3-Clause
// Loop detection against the size of the map: how long its index takes to build, how long a search as in a run takes
// (SearchPoses) and one that decides by itself (MatchLayouts, mirror image and all), and how often the answer is right.
// usage: loop_bench [OBJECTS...]
// Maps of constant density, three labels; local maps of 15 mapped objects and 3 others, noise 0.3 m per axis, one
// object of five missed, any heading. Prints one row for each map.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "sslcd/loop/decision.h"
#include "sslcd/loop/pose_tracks.h"
#include "sslcd/sim/random.h"

namespace sslcd {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kQueries = 200;

using Clock = std::chrono::steady_clock;
double MsSince(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

LayoutObject ObjectAt(double x, double y, sim::Random& random) {
  LayoutObject object;
  object.position = Vec3(x, y, 0.2 * random.Uniform());
  object.label = static_cast<int>(random.Uniform(0, 3));
  object.yaw = std::nan("");
  return object;
}

// Objects per square metre: 0.0076, which puts 15 of them within 25 m. `streets`: on both kerbs of streets that are
// 100 m apart, an object every 13 m or so of a kerb; else anywhere.
std::vector<LayoutObject> Map(int count, bool streets, sim::Random& random) {
  const double side = std::sqrt(count / 0.0076);
  std::vector<LayoutObject> map;
  for (int i = 0; i < count; ++i) {
    double x = random.Uniform(0, side), y = random.Uniform(0, side);
    if (streets) {
      y = 100 * std::floor(y / 100) + (random.Chance(0.5) ? 4 : -4) + random.Normal(0, 0.3);
      if (random.Chance(0.5)) std::swap(x, y);
    }
    map.push_back(ObjectAt(x, y, random));
  }
  return map;
}

// The objects nearest to one of the map, as another pass has them.
std::vector<LayoutObject> LocalMap(const std::vector<LayoutObject>& map, const YawShift& pose, sim::Random& random) {
  constexpr int kSeen = 15, kMissed = 4, kClutter = 3;
  const Vec3 centre = map[static_cast<std::size_t>(random.Uniform(0, static_cast<double>(map.size())))].position;
  std::vector<std::pair<double, int>> near;
  for (std::size_t i = 0; i < map.size(); ++i)
    near.push_back({(map[i].position - centre).head<2>().norm(), static_cast<int>(i)});
  std::partial_sort(near.begin(), near.begin() + kSeen + kMissed, near.end());
  std::vector<LayoutObject> local;
  for (int i = 0; i < kSeen + kMissed; ++i) local.push_back(map[near[i].second]);
  for (int i = 0; i < kMissed; ++i)
    local.erase(local.begin() + static_cast<std::ptrdiff_t>(random.Uniform(0, static_cast<double>(local.size()))));
  const double radius = near[kSeen + kMissed - 1].first;
  for (int i = 0; i < kClutter; ++i)
    local.push_back(
        ObjectAt(centre.x() + random.Uniform(-radius, radius), centre.y() + random.Uniform(-radius, radius), random));
  const YawShift turn{-pose.yaw, Vec3::Zero()};
  for (LayoutObject& object : local)
    object.position = Apply(turn, object.position - pose.t) +
                      Vec3(random.Normal(0, 0.3), random.Normal(0, 0.3), random.Normal(0, 0.05));
  return local;
}

double Quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

void Measure(int count, bool streets) {
  sim::Random random(7, static_cast<std::uint64_t>(count));
  const std::vector<LayoutObject> map = Map(count, streets, random);
  const LayoutMatchOptions options;
  std::vector<double> build_ms, search_ms, match_ms;
  PoseSearchOptions search = options.search;
  search.refine = PoseTrackOptions().max_tracks;
  for (int i = 0; i < (count > 5000 ? 3 : 50); ++i) {
    const auto start = Clock::now();
    const LayoutIndex again(map, options.max_pair_m, options.reach_m);
    build_ms.push_back(MsSince(start));
  }
  const LayoutIndex index(map, options.max_pair_m, options.reach_m);
  int right = 0, accepted = 0, wrong = 0;
  for (int query = 0; query < kQueries; ++query) {
    YawShift pose{random.Uniform(-kPi, kPi), Vec3(random.Uniform(-500, 500), random.Uniform(-500, 500), 2)};
    const std::vector<LayoutObject> local = LocalMap(map, pose, random);
    auto start = Clock::now();
    SearchPoses(LayoutLikelihood(local, index, options.likelihood), search);
    search_ms.push_back(MsSince(start));
    start = Clock::now();
    const LayoutAnswer answer = MatchLayouts(local, index, options);
    match_ms.push_back(MsSince(start));
    const Vec3 middle = local[0].position;
    const bool good =
        !answer.hypotheses.empty() && (Apply(answer.hypotheses[0].pose, middle) - Apply(pose, middle)).norm() < 2;
    right += good;
    if (answer.decision != LoopDecision::kAccepted) continue;
    accepted += good;
    wrong += !good;
  }
  std::printf(
      "%-7s %7d  build %8.2f ms  search p50 %6.2f  p95 %6.2f ms  match p50 %6.2f  p95 %6.2f ms  of %d: best right %d  "
      "accepted right %d  wrong %d\n",
      streets ? "streets" : "strewn", count, Quantile(build_ms, 0.5), Quantile(search_ms, 0.5),
      Quantile(search_ms, 0.95), Quantile(match_ms, 0.5), Quantile(match_ms, 0.95), kQueries, right, accepted, wrong);
  std::fflush(stdout);
}

}  // namespace
}  // namespace sslcd

int main(int argc, char** argv) {
  std::vector<int> counts{200, 500, 1000, 2000, 5000, 10000, 30000, 100000};
  if (argc > 1) counts.clear();
  for (int i = 1; i < argc; ++i) counts.push_back(std::max(30, std::atoi(argv[i])));
  for (const bool streets : {false, true})
    for (const int count : counts) sslcd::Measure(count, streets);
}
