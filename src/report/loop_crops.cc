// SPDX-License-Identifier: BSD-3-Clause
#include "report/loop_crops.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <set>

#include "perception/projection.h"

namespace sslcd {
namespace {

constexpr int kMostFramesAway = 150;  // from the camera of the loop
constexpr int kFramesOfASide = 3;
constexpr double kLeastWidthPx = 8, kLeastHeightPx = 20;
constexpr double kMostCovered = .3;  // of a box by one of a nearer object

using Sights = std::map<std::size_t, Sight>;  // by pair
using ObjectById = std::map<int, const MapObject*>;
using Views = std::map<int, std::map<int, Box2d>>;  // boxes of objects, by frame and id

struct Candidate {
  std::size_t pair = 0;
  int object = 0;  // id
  Box2d box;
};

struct Projected {
  int id = 0;
  Box2d box;
  double depth = 0;
};

bool IsCovered(const Projected& one, const std::vector<Projected>& all) {
  return std::any_of(all.begin(), all.end(), [&one](const Projected& other) {
    const Box2d common{std::max(one.box.left, other.box.left), std::max(one.box.top, other.box.top),
                       std::min(one.box.right, other.box.right),
                       std::min(one.box.bottom, other.box.bottom)};
    return other.depth < one.depth && common.Area() > kMostCovered * one.box.Area();
  });
}

// What each frame has observed, without what is small or behind something else.
Views ViewsOf(const RunView& run, const Camera& camera) {
  std::map<int, std::vector<Projected>> by_frame;
  for (const MapObject& object : run.map.objects) {
    for (const Observation& seen : object.observations) {
      const auto frame = static_cast<std::size_t>(seen.frame);
      if (seen.frame < 0 || frame >= run.trajectory.size()) continue;
      const Pose T = run.trajectory.poses[frame].inverse() * object.T_world_object;
      if (const auto box = ProjectCuboid(T, object.dims, camera))
        by_frame[seen.frame].push_back({object.id.value, *box, T.translation().z()});
    }
  }
  Views views;
  for (const auto& [frame, all] : by_frame)
    for (const Projected& one : all)
      if (one.box.right - one.box.left >= kLeastWidthPx &&
          one.box.bottom - one.box.top >= kLeastHeightPx && !IsCovered(one, all))
        views[frame][one.id] = one.box;
  return views;
}

// The landmark of one side of a pair; of two that were fused, the one that is left.
const MapObject* ObjectOf(const ObjectById& objects, LandmarkId own, LandmarkId other) {
  for (const LandmarkId id : {own, other})
    if (const auto found = objects.find(id.value); found != objects.end()) return found->second;
  return nullptr;
}

// The pairs that each frame near one camera of the loop has seen.
std::map<int, std::vector<Candidate>> CandidatesOf(const Views& views, const ObjectById& objects,
                                                   const LoopClosure& loop, bool query) {
  const int own = query ? loop.query_frame : loop.match_frame;
  const int other = query ? loop.match_frame : loop.query_frame;
  std::map<int, std::vector<Candidate>> by_frame;
  const auto end = views.upper_bound(own + kMostFramesAway);
  for (auto view = views.lower_bound(own - kMostFramesAway); view != end; ++view) {
    if (std::abs(view->first - own) >= std::abs(view->first - other)) continue;
    for (std::size_t i = 0; i < loop.pairs.size(); ++i) {
      const auto& [local, global] = loop.pairs[i];
      const MapObject* object =
          query ? ObjectOf(objects, local, global) : ObjectOf(objects, global, local);
      if (object == nullptr) continue;
      if (const auto box = view->second.find(object->id.value); box != view->second.end())
        by_frame[view->first].push_back({i, box->first, box->second});
    }
  }
  return by_frame;
}

std::set<std::size_t> PairsOf(const std::map<int, std::vector<Candidate>>& by_frame) {
  std::set<std::size_t> pairs;
  for (const auto& [frame, candidates] : by_frame)
    for (const Candidate& candidate : candidates) pairs.insert(candidate.pair);
  return pairs;
}

// A sight of those pairs that have one, from as few frames as see most of them.
Sights SightsOf(const std::map<int, std::vector<Candidate>>& by_frame,
                const std::set<std::size_t>& pairs) {
  Sights sights;
  for (int i = 0; i < kFramesOfASide; ++i) {
    std::pair<std::size_t, double> most{0, 0};  // pairs, area
    const std::pair<const int, std::vector<Candidate>>* best = nullptr;
    for (const auto& entry : by_frame) {
      std::pair<std::size_t, double> found{0, 0};
      for (const Candidate& candidate : entry.second) {
        if (sights.count(candidate.pair) > 0 || pairs.count(candidate.pair) == 0) continue;
        ++found.first;
        found.second += candidate.box.Area();
      }
      if (found > most) most = found, best = &entry;
    }
    if (best == nullptr) break;
    for (const Candidate& candidate : best->second)
      if (pairs.count(candidate.pair) > 0)
        sights.emplace(candidate.pair, Sight{best->first, candidate.object, candidate.box});
  }
  return sights;
}

}  // namespace

std::vector<SeenPair> SeenPairs(const RunView& run, const Camera& camera,
                                const CropLimits& limits) {
  ObjectById objects;
  for (const MapObject& object : run.map.objects) objects[object.id.value] = &object;
  const Views views = ViewsOf(run, camera);
  std::vector<std::size_t> accepted;
  for (std::size_t i = 0; i < run.loops.size(); ++i)
    if (run.loops[i].decision == LoopDecision::kAccepted) accepted.push_back(i);
  const std::size_t every = (accepted.size() + limits.loops - 1) / limits.loops;
  std::vector<SeenPair> pairs;
  for (std::size_t k = 0; k < accepted.size(); k += std::max<std::size_t>(1, every)) {
    const LoopClosure& loop = run.loops[accepted[k]];
    const auto near_query = CandidatesOf(views, objects, loop, true);
    const auto near_match = CandidatesOf(views, objects, loop, false);
    const Sights query = SightsOf(near_query, PairsOf(near_match));
    std::set<std::size_t> seen;
    for (const auto& [pair, sight] : query) seen.insert(pair);
    const Sights match = SightsOf(near_match, seen);
    std::size_t count = 0;
    for (const auto& [pair, sight] : query) {
      const auto other = match.find(pair);
      if (other == match.end() || ++count > limits.pairs) continue;
      pairs.push_back({accepted[k], pair, sight, other->second});
    }
  }
  return pairs;
}

}  // namespace sslcd
