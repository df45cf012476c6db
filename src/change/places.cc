// SPDX-License-Identifier: BSD-3-Clause
#include "change/places.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <tuple>

#include "association/spatial_index.h"
#include "change/looks.h"

namespace sslcd {
namespace {

// Set by hand: landmarks that are nearer than this are one place however small they are [m]; share
// of both sizes, which is half of a mean size; factor between the sizes of sightings of one object;
// share of the smaller number of sightings that may be of one frame, since a detector sometimes
// makes two boxes of one object.
constexpr double kNear = 0.6, kInside = 0.25, kSameSize = 1.6, kSlip = 0.1;
// Landmarks farther apart: largest distance [m], and how alike they have to look [nats].
constexpr double kFar = 5, kAlike = 1;
constexpr double kChiSquare99 = 9.21;  // 2 degrees of freedom

struct Pair {
  double apart = 0;
  int a = 0, b = 0;
  bool operator<(const Pair& other) const {
    return std::tie(apart, a, b) < std::tie(other.apart, other.a, other.b);
  }
};

class Grouping {
 public:
  explicit Grouping(const Sightings& sightings)
      : seen_(sightings.landmarks()), world_(sightings.world()), group_(seen_.size()) {
    std::iota(group_.begin(), group_.end(), 0);
    for (const LandmarkSightings& landmark : seen_) {
      frames_.push_back(landmark.frames);
      looks_.emplace_back();
      for (const SessionLooks& session : landmark.sessions) looks_.back().Merge(session, 0);
    }
  }

  void Join() {
    std::vector<Pair> pairs = Pairs();
    std::sort(pairs.begin(), pairs.end());
    for (const Pair& pair : pairs) Join(GroupOf(pair.a), GroupOf(pair.b));
  }

  std::vector<std::vector<int>> Groups() {
    std::vector<std::vector<int>> groups(seen_.size());
    for (std::size_t i = 0; i < seen_.size(); ++i)
      groups[GroupOf(static_cast<int>(i))].push_back(static_cast<int>(i));
    const auto is_no_place = [&](const std::vector<int>& group) {
      return std::none_of(group.begin(), group.end(), [&](int i) {
        return Stands(i) && world_.objects[i].state == LandmarkState::kConfirmed;
      });
    };
    groups.erase(std::remove_if(groups.begin(), groups.end(), is_no_place), groups.end());
    const auto rank = [&](int i) {
      return std::make_pair(world_.objects[i].state != LandmarkState::kConfirmed,
                            -static_cast<int>(seen_[i].frames.size()));
    };
    for (std::vector<int>& group : groups)
      std::stable_sort(group.begin(), group.end(), [&](int a, int b) { return rank(a) < rank(b); });
    return groups;
  }

 private:
  bool Stands(int i) const {
    return world_.objects[i].state != LandmarkState::kDynamic && !seen_[i].frames.empty();
  }

  std::vector<Pair> Pairs() const {
    SpatialIndex index;
    const auto level = [&](std::size_t i) -> Vec2 {
      const Vec3& p = world_.objects[i].T_world_object.translation();
      return {p.dot(world_.gravity.forward), p.dot(world_.gravity.left)};
    };
    for (std::size_t i = 0; i < seen_.size(); ++i)
      if (Stands(static_cast<int>(i))) index.Put(static_cast<int>(i), level(i).x(), level(i).y());
    std::vector<Pair> pairs;
    for (std::size_t i = 0; i < seen_.size(); ++i) {
      const int a = static_cast<int>(i);
      if (!Stands(a)) continue;
      for (const int b : index.FindWithin(level(i).x(), level(i).y(), kFar))
        if (a < b && IsOnePlace(a, b)) pairs.push_back({Apart(a, b).norm(), a, b});
    }
    return pairs;
  }

  Vec3 Apart(int a, int b) const {
    return world_.objects[b].T_world_object.translation() -
           world_.objects[a].T_world_object.translation();
  }

  bool IsOnePlace(int a, int b) const {
    const MapObject &one = world_.objects[a], &other = world_.objects[b];
    if (seen_[a].map != seen_[b].map) return false;
    const Vec3 ratio = one.dims.cwiseQuotient(other.dims);
    if (ratio.maxCoeff() > kSameSize || ratio.minCoeff() < 1 / kSameSize) return false;
    const Vec3 apart = Apart(a, b), room = kInside * (one.dims + other.dims);
    const double up = apart.dot(world_.gravity.up);
    if (std::abs(up) > std::max(kNear, room.z())) return false;
    const Vec3 level = apart - up * world_.gravity.up;
    if (level.norm() <= kNear) return true;
    const Symmetry symmetry = world_.labels[one.label].symmetry;
    const Vec3 own = one.T_world_object.so3().inverse() * level;
    if (symmetry == Symmetry::kFull ? level.norm() <= room.x()
                                    : std::hypot(own.x() / room.x(), own.y() / room.y()) <= 1)
      return true;
    return IsNoise(a, b, level) && LooksAlike(a, b, symmetry);
  }

  // Whether the detector's errors explain the distance. They rotate with the viewing ray and
  // correlate from frame to frame, so a mean over sightings has the error of a single one.
  bool IsNoise(int a, int b, const Vec3& level) const {
    const Eigen::Matrix3d covariance = OneSighting(a) + OneSighting(b);
    return level.dot(covariance.ldlt().solve(level)) <= kChiSquare99;
  }

  Eigen::Matrix3d OneSighting(int i) const {
    return (seen_[i].information / static_cast<double>(seen_[i].frames.size())).inverse();
  }

  bool LooksAlike(int a, int b, Symmetry symmetry) const {
    SessionLooks turned;
    turned.Merge(looks_[b], world_.gravity.YawOf(world_.objects[b].T_world_object.so3()) -
                                world_.gravity.YawOf(world_.objects[a].T_world_object.so3()));
    return LogSameObject(Compare(looks_[a], turned, symmetry), LookStatistics::Prior()) >= kAlike;
  }

  int GroupOf(int i) {
    while (group_[i] != i) i = group_[i] = group_[group_[i]];
    return i;
  }

  void Join(int a, int b) {
    if (a == b) return;
    std::vector<int> both;
    std::set_intersection(frames_[a].begin(), frames_[a].end(), frames_[b].begin(),
                          frames_[b].end(), std::back_inserter(both));
    const auto fewer = static_cast<double>(std::min(frames_[a].size(), frames_[b].size()));
    if (static_cast<double>(both.size()) > kSlip * fewer) return;
    std::vector<int> all;
    std::merge(frames_[a].begin(), frames_[a].end(), frames_[b].begin(), frames_[b].end(),
               std::back_inserter(all));
    group_[std::max(a, b)] = std::min(a, b);
    frames_[std::min(a, b)] = std::move(all);
  }

  const std::vector<LandmarkSightings>& seen_;
  const HistoryWorld& world_;
  std::vector<SessionLooks> looks_;  // over all sessions
  std::vector<int> group_;
  std::vector<std::vector<int>> frames_;  // of each group, by its first landmark
};

}  // namespace

std::vector<Place> FindPlaces(const Sightings& sightings) {
  const HistoryWorld& world = sightings.world();
  Grouping grouping(sightings);
  grouping.Join();
  std::vector<Place> places;
  for (std::vector<int>& group : grouping.Groups()) {
    const MapObject& first = world.objects[group.front()];
    Place place;
    place.label = first.label;
    place.symmetry = world.labels[first.label].symmetry;
    place.T_world_object = first.T_world_object;
    place.dims = first.dims;
    place.map = sightings.landmarks()[group.front()].map;
    place.sessions.resize(world.sessions);
    for (const int landmark : group) {
      const double turn = world.gravity.YawOf(world.objects[landmark].T_world_object.so3()) -
                          world.gravity.YawOf(first.T_world_object.so3());
      for (int s = 0; s < world.sessions; ++s)
        place.sessions[s].Merge(sightings.landmarks()[landmark].sessions[s], turn);
    }
    place.landmarks = std::move(group);
    places.push_back(std::move(place));
  }
  return places;
}

}  // namespace sslcd
