// SPDX-License-Identifier: BSD-3-Clause
#include "map_results.h"

#include <pybind11/stl.h>

#include "arrays.h"
#include "core/sha256.h"
#include "frames.h"
#include "results.h"

namespace sslcd::python {
namespace {

using namespace py::literals;

// Makes a dataclass of sslcd.map_results.
template <class... Arguments>
py::object MakeMap(const char* type, Arguments&&... arguments) {
  return py::module_::import("sslcd.map_results").attr(type)(std::forward<Arguments>(arguments)...);
}

template <class Items>
py::list MapListOf(const Items& items) {
  py::list list;
  for (const auto& item : items) list.append(ToPython(item));
  return list;
}

template <class Number>
py::object Evidence(const PlaceHistory& place, Number SessionEvidence::*member) {
  return Column<Number>(place.sessions,
                        [member](const SessionEvidence& one) { return one.*member; });
}

}  // namespace

py::dict ToPython(const LabelTable& labels) {
  py::dict made;
  for (const auto& [label, info] : labels.entries()) made[Text(label)] = ToString(info.symmetry);
  return made;
}

py::object ToPython(const SessionInfo& session) {
  return MakeMap("SessionInfo", "name"_a = Text(session.name), "ended"_a = session.ended,
                 "frames"_a = session.frames, "frame_offset"_a = session.frame_offset,
                 "inputs"_a = session.inputs, "checksum"_a = Hexadecimal(session.checksum),
                 "dataset"_a = Text(session.dataset), "command"_a = Text(session.command),
                 "program"_a = Text(session.program), "started"_a = Text(session.started));
}

py::object ToPython(const MapInfo& info) {
  py::dict lengths;
  for (const CueRow& row : kCueRows) lengths[row.name] = info.vector_length[row.cue];
  return MakeMap("MapInfo", "up"_a = ToArray(info.up_axis), "labels"_a = ToPython(info.labels),
                 "camera"_a = ToPython(info.camera), "vector_lengths"_a = lengths,
                 "config"_a = Text(info.config), "created"_a = Text(info.created),
                 "sessions"_a = MapListOf(info.sessions), "file_bytes"_a = info.file_bytes);
}

py::object ToPython(const MapResults& results, const MapInfo& info) {
  py::dict trajectories, odometry;
  for (const SessionPath& path : results.paths)
    for (const SessionInfo& session : info.sessions) {
      if (session.id != path.session) continue;
      trajectories[Text(session.name)] = ToPython(path.trajectory, path.frames);
      odometry[Text(session.name)] = ToPython(path.odometry, path.frames);
    }
  return MakeMap("MapResults", "trajectories"_a = trajectories, "odometry"_a = odometry,
                 "objects"_a = ListOf(results.objects), "loops"_a = ListOf(results.loops),
                 "parts"_a = ListOf(results.parts), "graph"_a = ToPython(results.graph),
                 "scale"_a = results.scale, "noise_scale"_a = ToPython(results.noise_scale));
}

py::object ToPython(const Localisation& found) {
  const bool has_pose = !found.pairs.empty();
  const auto pose = [&](const Pose& T) { return has_pose ? py::object(ToArray(T)) : py::none(); };
  py::array_t<int> pairs(std::vector<py::ssize_t>{static_cast<py::ssize_t>(found.pairs.size()), 2});
  int* value = pairs.mutable_data();
  for (const auto& [here, there] : found.pairs) {
    *value++ = here.value;
    *value++ = there.value;
  }
  return MakeMap("Localisation", "frame"_a = found.frame, "decision"_a = ToString(found.decision),
                 "reason"_a = found.reason, "score"_a = found.score,
                 "probability"_a = found.probability, "T_map_cam"_a = pose(found.T_map_cam),
                 "T_map_odom"_a = pose(found.T_map_odom),
                 "covariance"_a = has_pose ? py::object(ToArray(found.covariance)) : py::none(),
                 "travelled"_a = found.travelled_m, "objects_in_view"_a = found.objects_in_view,
                 "pairs"_a = pairs);
}

py::object ToPython(const PlaceHistory& place) {
  return MakeMap(
      "PlaceHistory",
      "landmarks"_a = Column<int>(place.landmarks, [](LandmarkId id) { return id.value; }),
      "label"_a = Text(place.label), "T_world_object"_a = ToArray(place.T_world_object),
      "dims"_a = ToArray(place.dims), "map"_a = place.map,
      "seen"_a = Evidence(place, &SessionEvidence::seen),
      "expected"_a = Evidence(place, &SessionEvidence::expected),
      "probability"_a = Evidence(place, &SessionEvidence::probability));
}

py::object ToPython(const ChangeRates& rates) {
  return MakeMap("ChangeRates", "departure"_a = rates.departure, "replaced"_a = rates.replaced,
                 "arrival"_a = rates.arrival);
}

py::object ToPython(const PlaceOutcome& outcome) {
  return MakeMap("PlaceOutcome", "stayed"_a = outcome.stayed, "departed"_a = outcome.departed,
                 "replaced"_a = outcome.replaced, "arrived"_a = outcome.arrived,
                 "empty"_a = outcome.empty);
}

py::object ToPython(const MapDiff& diff, const MapInfo& info) {
  py::list changes;
  for (const PlaceChange& change : diff.changes)
    changes.append(MakeMap("PlaceChange", "kind"_a = ToString(change.kind),
                           "probability"_a = change.probability, "place"_a = change.place));
  return MakeMap("MapDiff", "before"_a = Text(info.sessions[diff.from].name),
                 "after"_a = Text(info.sessions[diff.to].name), "changes"_a = changes,
                 "stayed"_a = diff.stayed, "unknown"_a = diff.unknown, "unseen"_a = diff.unseen);
}

py::object ToPython(const MergeReport& report) {
  py::list added, left_out;
  for (const MergedSession& one : report.added)
    added.append(MakeMap("MergedSession", "map"_a = Text(one.map),
                         "old_name"_a = Text(one.old_name), "name"_a = Text(one.name),
                         "frames"_a = one.frames));
  for (const std::string& one : report.left_out) left_out.append(Text(one));
  return MakeMap("MergeReport", "added"_a = added, "left_out"_a = left_out);
}

}  // namespace sslcd::python
