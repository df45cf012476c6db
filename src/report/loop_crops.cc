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
constexpr int kFramesOfASide = 2;
constexpr double kLeastWidthPx = 8, kLeastHeightPx = 12;

using Sights = std::map<std::size_t, Sight>;  // by pair
using ObjectById = std::map<int, const MapObject*>;

struct Candidate {
  std::size_t pair = 0;
  Box2d box;
};

std::optional<Box2d> BoxOf(const RunView& run, const MapObject& object, int frame,
                           const Camera& camera) {
  const Pose& T_world_cam = run.trajectory.poses[static_cast<std::size_t>(frame)];
  const auto box =
      ProjectCuboid(T_world_cam.inverse() * object.T_world_object, object.dims, camera);
  if (!box || box->right - box->left < kLeastWidthPx || box->bottom - box->top < kLeastHeightPx)
    return std::nullopt;
  return box;
}

// The landmark of one side of a pair; of two that were fused, the one that is left.
const MapObject* ObjectOf(const ObjectById& objects, LandmarkId own, LandmarkId other) {
  for (const LandmarkId id : {own, other})
    if (const auto found = objects.find(id.value); found != objects.end()) return found->second;
  return nullptr;
}

// The pairs that each frame near one camera of the loop has seen.
std::map<int, std::vector<Candidate>> CandidatesOf(const RunView& run, const ObjectById& objects,
                                                   const LoopClosure& loop, bool query,
                                                   const Camera& camera) {
  const int own = query ? loop.query_frame : loop.match_frame;
  const int other = query ? loop.match_frame : loop.query_frame;
  std::map<int, std::vector<Candidate>> by_frame;
  for (std::size_t i = 0; i < loop.pairs.size(); ++i) {
    const auto& [local, global] = loop.pairs[i];
    const MapObject* object =
        query ? ObjectOf(objects, local, global) : ObjectOf(objects, global, local);
    if (object == nullptr) continue;
    for (const Observation& seen : object->observations) {
      const int away = std::abs(seen.frame - own);
      if (seen.frame < 0 || static_cast<std::size_t>(seen.frame) >= run.trajectory.size() ||
          away > kMostFramesAway || away >= std::abs(seen.frame - other))
        continue;
      if (const auto box = BoxOf(run, *object, seen.frame, camera))
        by_frame[seen.frame].push_back({i, *box});
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
        sights.emplace(candidate.pair, Sight{best->first, candidate.box});
  }
  return sights;
}

}  // namespace

std::vector<SeenPair> SeenPairs(const RunView& run, const Camera& camera,
                                const CropLimits& limits) {
  ObjectById objects;
  for (const MapObject& object : run.map.objects) objects[object.id.value] = &object;
  std::vector<std::size_t> accepted;
  for (std::size_t i = 0; i < run.loops.size(); ++i)
    if (run.loops[i].decision == LoopDecision::kAccepted) accepted.push_back(i);
  const std::size_t every = (accepted.size() + limits.loops - 1) / limits.loops;
  std::vector<SeenPair> pairs;
  for (std::size_t k = 0; k < accepted.size(); k += std::max<std::size_t>(1, every)) {
    const LoopClosure& loop = run.loops[accepted[k]];
    const auto near_query = CandidatesOf(run, objects, loop, true, camera);
    const auto near_match = CandidatesOf(run, objects, loop, false, camera);
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
