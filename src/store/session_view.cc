// SPDX-License-Identifier: BSD-3-Clause
#include "store/session_view.h"

#include <algorithm>
#include <set>

namespace sslcd {
namespace {

// The frames of a session, by their numbers in the map.
struct FrameRange {
  int first = 0, last = -1;
  bool Has(int frame) const { return first <= frame && frame <= last; }
};

FrameRange FramesOf(const SessionInfo& session) {
  return {session.frame_offset, session.last_frame.value_or(-1)};
}

MapObject SeenIn(const FrameRange& range, const MapObject& object) {
  MapObject seen = object;
  seen.observations.clear();
  for (Observation observation : object.observations) {
    if (!range.Has(observation.frame)) continue;
    observation.frame -= range.first;
    seen.observations.push_back(observation);
  }
  return seen;
}

PoseGraph GraphWithin(const FrameRange& range, const PoseGraph& map) {
  PoseGraph graph;
  for (PoseGraph::Vertex vertex : map.vertices) {
    if (!range.Has(vertex.id)) continue;
    vertex.id -= range.first;
    vertex.fixed = graph.vertices.empty();
    graph.vertices.push_back(vertex);
  }
  for (PoseGraph::Edge edge : map.edges) {
    if (!range.Has(edge.from) || !range.Has(edge.to)) continue;
    edge.from -= range.first;
    edge.to -= range.first;
    graph.edges.push_back(edge);
  }
  return graph;
}

}  // namespace

MapResults ResultsOfSession(const MapResults& map, const SessionInfo& session) {
  const FrameRange range = FramesOf(session);
  MapResults results;
  results.inputs = map.inputs;
  results.scale = map.scale;
  results.noise_scale = map.noise_scale;
  for (const SessionPath& path : map.paths) {
    if (path.session != session.id) continue;
    results.paths.push_back(path);
    for (int& frame : results.paths.back().frames) frame -= range.first;
  }
  for (const MapObject& object : map.objects) {
    MapObject seen = SeenIn(range, object);
    if (!seen.observations.empty()) results.objects.push_back(std::move(seen));
  }
  for (LoopClosure loop : map.loops) {
    if (!range.Has(loop.query_frame) || !range.Has(loop.match_frame)) continue;
    for (int* frame : {&loop.newest_frame, &loop.query_frame, &loop.match_frame})
      *frame -= range.first;
    results.loops.push_back(std::move(loop));
  }
  results.graph = GraphWithin(range, map.graph);
  return results;
}

int LoopsToEarlierSessions(const MapResults& map, const SessionInfo& session) {
  const FrameRange range = FramesOf(session);
  return static_cast<int>(
      std::count_if(map.loops.begin(), map.loops.end(), [&](const LoopClosure& loop) {
        return loop.decision == LoopDecision::kAccepted && range.Has(loop.query_frame) &&
               loop.match_frame < range.first;
      }));
}

std::vector<std::string> JoinedSessions(const MapInfo& info, const MapResults& map,
                                        const SessionInfo& session) {
  const auto maps_of = [&](const SessionInfo& one) {
    std::set<int> maps;
    for (const MapPart& part : map.parts)
      if (FramesOf(one).Has(part.first_frame)) maps.insert(part.joined_with);
    return maps;
  };
  const std::set<int> own = maps_of(session);
  std::vector<std::string> names;
  for (const SessionInfo& other : info.sessions) {
    const std::set<int> maps = maps_of(other);
    if (other.id != session.id &&
        std::any_of(maps.begin(), maps.end(), [&](int number) { return own.count(number) > 0; }))
      names.push_back(other.name);
  }
  return names;
}

}  // namespace sslcd
