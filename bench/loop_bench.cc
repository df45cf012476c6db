// SPDX-License-Identifier: BSD-3-Clause
// Loop detection against the size of the map: times of building the index, of a search like in a
// run (SearchPoses) and of a single decision (MatchLayouts, with the mirror image), and the share
// of correct answers. Then complete attempts of a run with a map of that size: the layouts, their
// changes, the update of the index and the search.
//
//   loop_bench [OBJECTS...]
//
// Maps of constant density, three labels: strewn, along streets, and car parks with regular rows;
// local maps of 15 mapped objects and 3 others, noise 0.3 m
// per axis, one object of five missed, any heading. Prints one row for each map.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include "closing/pass_layout.h"
#include "closing/pass_map.h"
#include "loop/indexed_match.h"
#include "loop/pose_tracks.h"
#include "sim/random.h"

namespace sslcd {
namespace {

constexpr int kQueries = 200;

// CPU time, so that other programs do not count.
double MsSince(std::clock_t start) {
  return 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

LayoutObject ObjectAt(double x, double y, sim::Random& random) {
  LayoutObject object;
  object.position = Vec3(x, y, 0.2 * random.Uniform());
  object.label = static_cast<int>(random.Uniform(0, 3));
  object.yaw = std::nan("");
  return object;
}

enum class World { kStrewn, kStreets, kLots };

const char* NameOf(World world) {
  constexpr const char* kNames[] = {"strewn", "streets", "lots"};
  return kNames[static_cast<int>(world)];
}

// Car parks of 33 x 7 places, 2.5 m and 8 m apart, of which three of five are taken, 105 m and 75 m
// from one to the next.
std::vector<LayoutObject> Lots(int count, sim::Random& random) {
  const int per_row = std::max(1, static_cast<int>(std::sqrt(count / 139. * 75 / 105)));
  std::vector<LayoutObject> map;
  for (int lot = 0; static_cast<int>(map.size()) < count; ++lot)
    for (int place = 0; place < 33 * 7 && static_cast<int>(map.size()) < count; ++place) {
      if (!random.Chance(0.6)) continue;
      const double x = 105. * (lot % per_row) + 2.5 * (place % 33),
                   y = 75. * (lot / per_row) + 8. * (place / 33);
      map.push_back(ObjectAt(x + random.Normal(0, 0.15), y + random.Normal(0, 0.25), random));
    }
  return map;
}

// 0.0076 objects per square metre, which are 15 within 25 m. Streets: on both kerbs of streets that
// are 100 m apart, about one object per 13 m of kerb. Strewn: anywhere.
std::vector<LayoutObject> Map(int count, World world, sim::Random& random) {
  if (world == World::kLots) return Lots(count, random);
  const bool streets = world == World::kStreets;
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

// The objects nearest to one of the map, observed on another pass.
std::vector<LayoutObject> LocalMap(const std::vector<LayoutObject>& map, const YawShift& pose,
                                   sim::Random& random) {
  constexpr int kSeen = 15, kMissed = 4, kClutter = 3;
  const Vec3 centre =
      map[static_cast<std::size_t>(random.Uniform(0, static_cast<double>(map.size())))].position;
  std::vector<std::pair<double, int>> near;
  for (std::size_t i = 0; i < map.size(); ++i)
    near.push_back({(map[i].position - centre).head<2>().norm(), static_cast<int>(i)});
  std::partial_sort(near.begin(), near.begin() + kSeen + kMissed, near.end());
  std::vector<LayoutObject> local;
  for (int i = 0; i < kSeen + kMissed; ++i) local.push_back(map[near[i].second]);
  for (int i = 0; i < kMissed; ++i)
    local.erase(local.begin() +
                static_cast<std::ptrdiff_t>(random.Uniform(0, static_cast<double>(local.size()))));
  const double radius = near[kSeen + kMissed - 1].first;
  for (int i = 0; i < kClutter; ++i)
    local.push_back(ObjectAt(centre.x() + random.Uniform(-radius, radius),
                             centre.y() + random.Uniform(-radius, radius), random));
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

void Measure(int count, World world) {
  sim::Random random(7, static_cast<std::uint64_t>(count));
  const std::vector<LayoutObject> map = Map(count, world, random);
  const LayoutMatchOptions options;
  std::vector<double> build_ms, search_ms, match_ms;
  PoseSearchOptions search = options.search;
  search.refine = PoseTrackOptions().max_tracks;
  for (int i = 0; i < (count > 5000 ? 3 : 50); ++i) {
    const auto start = std::clock();
    const LayoutIndex again(map, options.max_pair_m, options.reach_m);
    build_ms.push_back(MsSince(start));
  }
  const LayoutIndex index(map, options.max_pair_m, options.reach_m);
  int right = 0, accepted = 0, wrong = 0;
  for (int query = 0; query < kQueries; ++query) {
    YawShift pose{random.Uniform(-M_PI, M_PI),
                  Vec3(random.Uniform(-500, 500), random.Uniform(-500, 500), 2)};
    const std::vector<LayoutObject> local = LocalMap(map, pose, random);
    auto start = std::clock();
    SearchPoses(LayoutLikelihood(local, index, options.likelihood), search);
    search_ms.push_back(MsSince(start));
    start = std::clock();
    const LayoutAnswer answer = MatchLayouts(local, index, options);
    match_ms.push_back(MsSince(start));
    const Vec3 middle = local[0].position;
    const bool good = !answer.hypotheses.empty() &&
                      (Apply(answer.hypotheses[0].pose, middle) - Apply(pose, middle)).norm() < 2;
    right += good;
    if (answer.decision != LoopDecision::kAccepted) continue;
    accepted += good;
    wrong += !good;
  }
  std::printf(
      "%-7s %7d  build %8.2f ms  search p50 %6.2f  p95 %6.2f ms  match p50 %6.2f  p95 %6.2f ms  of "
      "%d: best right %d  "
      "accepted right %d  wrong %d\n",
      NameOf(world), count, Quantile(build_ms, 0.5), Quantile(search_ms, 0.5),
      Quantile(search_ms, 0.95), Quantile(match_ms, 0.5), Quantile(match_ms, 0.95), kQueries, right,
      accepted, wrong);
  std::fflush(stdout);
}

/// A run through a map, row by row: ten new objects and two old ones every 5 m, each seen by two
/// frames.
class Run {
 public:
  Run(std::vector<LayoutObject> objects, sim::Random& random)
      : random_(random), objects_(std::move(objects)) {
    constexpr double kRow = 30.;  // [m]
    std::sort(objects_.begin(), objects_.end(), [](const LayoutObject& a, const LayoutObject& b) {
      const double row_a = std::floor(a.position.y() / kRow),
                   row_b = std::floor(b.position.y() / kRow);
      return row_a != row_b ? row_a < row_b : a.position.x() < b.position.x();
    });
  }

  const std::vector<LayoutObject>& objects() const { return objects_; }
  PassLayout Recent(double path_m) const {
    return PassLayouts(passes_, state_).Recent(travelled() - path_m, kMinSightings);
  }
  /// Time since the last call.
  LayoutChanges ChangesBefore(double path_m) {
    return PassLayouts(passes_, state_).ChangesBefore(travelled() - path_m, kMinSightings, mark_);
  }

  void Drive() {
    constexpr int kNew = 10, kOld = 2;
    std::vector<LandmarkId> seen;
    for (int i = 0; i < kOld && next_ > 500; ++i)
      seen.push_back(
          ids_[static_cast<std::size_t>(random_.Uniform(0, static_cast<double>(next_ - 400)))]);
    for (int i = 0; i < kNew && next_ < objects_.size(); ++i, ++next_) {
      MapLandmark landmark;
      landmark.label = std::to_string(objects_[next_].label);
      landmark.symmetry = Symmetry::kFull;
      landmark.state = LandmarkState::kConfirmed;
      landmark.pose.position = state_.gravity().Basis() * objects_[next_].position;
      ids_.push_back(state_.map.Insert(landmark));
      seen.push_back(ids_.back());
    }
    for (int i = 0; i < 2; ++i) {
      FrameRecord frame;
      frame.frame = state_.frames.size();
      frame.T_odom_cam.translation() = Vec3(0, 0, 2.5 * frame.frame);
      frame.matched = seen;
      for (const LandmarkId id : seen)
        frame.detections.emplace_back().T_cam_object =
            ToPose(state_.map.at(id).pose, state_.gravity());
      state_.frames.Append(std::move(frame));
      passes_.AddFrame(state_, state_.frames.back().detections);
    }
    const int count = state_.frames.size();
    for (int i = std::max(0, count - 4); i < count; ++i)  // moved by the sliding window
      state_.frames.SetPose(i, state_.frames[i].T_world_cam);
  }

 private:
  static constexpr int kMinSightings = 2;
  double travelled() const { return state_.frames.back().travelled; }

  sim::Random& random_;
  std::vector<LayoutObject> objects_;
  std::vector<LandmarkId> ids_;
  std::size_t next_ = 0;
  MapState state_{ObjectMap(GravityFrame(), LabelTable(), {}, {}, {}), {}};
  PassMap passes_{{}, 30.};
  PassLayouts::Mark mark_;
};

void MeasureAttempts(int count, World world) {
  constexpr int kAttempts = 60;
  constexpr double kLocal = 75.,
                   kOld = 85.;  // path from the ends of the two layouts to the newest frame [m]
  const LayoutMatchOptions options;
  PoseSearchOptions search = options.search;
  search.refine = PoseTrackOptions().max_tracks;
  sim::Random random(8, static_cast<std::uint64_t>(count));
  Run run(Map(count + 10 * kAttempts, world, random), random);
  for (int driven = 0; driven < count; driven += 10) run.Drive();
  LayoutIndex index(run.ChangesBefore(kOld).objects, options.max_pair_m, options.reach_m);
  std::vector<double> layouts_ms, follow_ms, search_ms, whole_ms;
  double changed = 0;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    run.Drive();
    const std::vector<LayoutObject> local = LocalMap(index.objects(), {1, Vec3(3, 4, 0)}, random);
    const auto start = std::clock();
    run.Recent(kLocal);
    const LayoutChanges changes = run.ChangesBefore(kOld);
    layouts_ms.push_back(MsSince(start));
    index.Update(changes.objects, changes.gone);
    follow_ms.push_back(MsSince(start) - layouts_ms.back());
    SearchPoses(LayoutLikelihood(local, index, options.likelihood), search);
    whole_ms.push_back(MsSince(start));
    search_ms.push_back(whole_ms.back() - follow_ms.back() - layouts_ms.back());
    changed += static_cast<double>(changes.objects.size()) / kAttempts;
  }
  std::printf(
      "%-7s %7d  attempt: %4.1f objects change  layouts p50 %6.2f  index p50 %6.2f  p95 %6.2f  "
      "search p50 %6.2f  "
      "whole p50 %6.2f  p95 %6.2f ms\n",
      NameOf(world), count, changed, Quantile(layouts_ms, 0.5), Quantile(follow_ms, 0.5),
      Quantile(follow_ms, 0.95), Quantile(search_ms, 0.5), Quantile(whole_ms, 0.5),
      Quantile(whole_ms, 0.95));
  std::fflush(stdout);
}

}  // namespace
}  // namespace sslcd

int main(int argc, char** argv) {
  std::vector<int> counts{200, 500, 1000, 2000, 5000, 10000, 30000, 100000};
  if (argc > 1) counts.clear();
  for (int i = 1; i < argc; ++i) counts.push_back(std::max(30, std::atoi(argv[i])));
  for (const sslcd::World world :
       {sslcd::World::kStrewn, sslcd::World::kStreets, sslcd::World::kLots})
    for (const int count : counts) {
      sslcd::Measure(count, world);
      sslcd::MeasureAttempts(count, world);
    }
}
