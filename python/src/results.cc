// SPDX-License-Identifier: BSD-3-Clause
#include "results.h"

#include <pybind11/stl.h>

#include "arrays.h"
#include "sslcd/core/timing.h"

namespace sslcd::python {
namespace {

using namespace py::literals;

// [N, 2] from a list; `numbers_of(item)` gives the two.
template <class Items, class NumbersOf>
py::array_t<int> Pairs(const Items& items, const NumbersOf& numbers_of) {
  py::array_t<int> array(std::vector<py::ssize_t>{static_cast<py::ssize_t>(items.size()), 2});
  int* value = array.mutable_data();
  for (const auto& item : items) {
    const std::pair<int, int> numbers = numbers_of(item);
    *value++ = numbers.first;
    *value++ = numbers.second;
  }
  return array;
}

}  // namespace

py::str Text(const std::string& text) {
  return py::reinterpret_steal<py::str>(
      PyUnicode_DecodeUTF8(text.data(), static_cast<py::ssize_t>(text.size()), "backslashreplace"));
}

py::object ToPython(const LoopClosure& loop) {
  return Make("LoopClosure", "id"_a = loop.id, "newest_frame"_a = loop.newest_frame,
              "query_frame"_a = loop.query_frame, "match_frame"_a = loop.match_frame,
              "decision"_a = ToString(loop.decision), "reason"_a = loop.reason,
              "score"_a = loop.score, "second_score"_a = loop.second_score,
              "probability"_a = loop.probability, "T_match_query"_a = ToArray(loop.T_match_query),
              "covariance"_a = ToArray(loop.covariance), "by_views"_a = loop.by_views,
              "early"_a = loop.early, "viewpoint_change"_a = loop.viewpoint_change_rad,
              "pairs"_a = Pairs(loop.pairs, [](const auto& pair) {
                return std::pair(pair.first.value, pair.second.value);
              }));
}

py::object ToPython(const MapObject& object) {
  return Make("MapObject", "id"_a = object.id.value, "label"_a = Text(object.label),
              "state"_a = ToString(object.state),
              "T_world_object"_a = ToArray(object.T_world_object), "dims"_a = ToArray(object.dims),
              "observations"_a = Pairs(object.observations, [](const Observation& seen) {
                return std::pair(seen.frame, seen.detection_row);
              }));
}

py::object ToPython(const MapPart& part) {
  return Make("MapPart", "first_frame"_a = part.first_frame, "sequence"_a = part.sequence,
              "joined_with"_a = part.joined_with);
}

py::object ToPython(const MapChanges& changes) {
  py::object poses =
      Make("Trajectory",
           "frames"_a = Column<int>(changes.poses, [](const FramePose& p) { return p.frame; }),
           "stamps"_a = Column<double>(changes.poses, [](const FramePose& p) { return p.stamp; }),
           "poses"_a = Stack<4, 4>(changes.poses,
                                   [](const FramePose& p) { return p.T_world_cam.matrix(); }));
  return Make("MapChanges", "T_world_odom"_a = ToArray(changes.T_world_odom),
              "scale"_a = changes.scale, "poses"_a = poses, "loops"_a = ListOf(changes.loops),
              "parts"_a = ListOf(changes.parts));
}

py::object ToPython(const FilterReport& filter) {
  return Make("FilterReport", "kept"_a = filter.kept, "invalid"_a = filter.invalid,
              "low_score"_a = filter.low_score, "too_far"_a = filter.too_far,
              "wrong_size"_a = filter.wrong_size, "too_many"_a = filter.too_many);
}

py::object ToPython(const BaSummary& summary) {
  return Make("AdjustmentSummary", "usable"_a = summary.usable, "converged"_a = summary.converged,
              "iterations"_a = summary.iterations, "initial_cost"_a = summary.initial_cost,
              "final_cost"_a = summary.final_cost, "message"_a = summary.message);
}

py::object ToPython(const FrameReport& report, const std::vector<int>& kept, std::size_t given) {
  std::vector<int> matched(given, -1);
  for (std::size_t i = 0; i < report.map.matched.size(); ++i)
    matched.at(kept.at(i)) = report.map.matched[i].value;
  py::object map = Make("MapUpdate", "matched"_a = Column<int>(matched, [](int id) { return id; }),
                        "born"_a = report.map.born, "confirmed"_a = report.map.confirmed,
                        "turned_dynamic"_a = report.map.turned_dynamic);
  return Make("FrameReport", "T_world_cam"_a = ToArray(report.T_world_cam),
              "keyframe"_a = report.keyframe, "changes"_a = ToPython(report.changes),
              "filter"_a = ToPython(report.filter), "map"_a = map,
              "window"_a = ToPython(report.window));
}

py::object ToPython(const LoopSearchSummary& summary) {
  return Make("LoopSearchSummary", "searches"_a = summary.searches, "accepted"_a = summary.accepted,
              "without_candidate"_a = summary.without_candidate, "refused"_a = summary.refused,
              "up_axis_is_plausible"_a = summary.up_axis_is_plausible, "text"_a = summary.Text());
}

py::object ToPython(const ImprovementProbability& improvement) {
  return Make("Improvement", "horizontal"_a = improvement.horizontal,
              "height"_a = improvement.height);
}

py::object ToPython(const NoiseScale& scale) {
  return Make("NoiseScale", "radial"_a = scale.radial, "lateral"_a = scale.lateral,
              "vertical"_a = scale.vertical, "yaw"_a = scale.yaw);
}

py::object ToPython(const AsyncReport& report) {
  return Make("AsyncReport", "changes"_a = ToPython(report.changes), "frames"_a = report.frames,
              "dropped"_a = report.dropped, "refused"_a = report.refused,
              "refusal"_a = report.refusal, "failure"_a = report.failure);
}

py::object ToPython(const PoseGraph& graph) {
  using Vertex = PoseGraph::Vertex;
  using Edge = PoseGraph::Edge;
  return Make(
      "PoseGraph", "ids"_a = Column<int>(graph.vertices, [](const Vertex& v) { return v.id; }),
      "poses"_a = ToArray(PosesOf(graph)),
      "fixed"_a = Column<bool>(graph.vertices, [](const Vertex& v) { return v.fixed; }),
      "edges"_a = Pairs(graph.edges, [](const Edge& e) { return std::pair(e.from, e.to); }),
      "measurements"_a =
          Stack<4, 4>(graph.edges, [](const Edge& e) { return e.T_from_to.matrix(); }),
      "information"_a = Stack<6, 6>(graph.edges, [](const Edge& e) { return e.information; }),
      "loops"_a = Column<bool>(graph.edges, [](const Edge& e) { return e.loop; }));
}

py::object ToPython(const std::map<std::string, StageTimes>& timing) {
  py::dict stages;
  for (const auto& [stage, times] : timing)
    stages[py::str(stage)] = Make("StageTimes", "count"_a = times.count, "mean"_a = times.mean,
                                  "p50"_a = times.p50, "p95"_a = times.p95, "max"_a = times.max);
  return stages;
}

py::object ToPython(const Trajectory& trajectory, const std::vector<int>& frames) {
  return Make("Trajectory", "frames"_a = Column<int>(frames, [](int frame) { return frame; }),
              "stamps"_a = Column<double>(trajectory.stamps, [](double stamp) { return stamp; }),
              "poses"_a = ToArray(trajectory.poses));
}

}  // namespace sslcd::python
