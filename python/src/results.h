// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "sslcd/pipeline/async_mapper.h"
#include "sslcd/pipeline/mapper.h"

namespace sslcd {
struct StageTimes;
}

namespace sslcd::python {

namespace py = pybind11;

/// Makes a dataclass of sslcd.results: Make("Improvement", py::arg("horizontal") = .9, ...).
template <class... Arguments>
py::object Make(const char* type, Arguments&&... arguments) {
  return py::module_::import("sslcd.results").attr(type)(std::forward<Arguments>(arguments)...);
}

/// A text of a file, which may be no UTF-8: other bytes become \xNN.
py::str Text(const std::string& text);

/// `items` as a list, each by ToPython.
template <class Items>
py::list ListOf(const Items& items);

/// The dataclass of the same name in sslcd.results, which documents the fields.
py::object ToPython(const LoopClosure& loop);
py::object ToPython(const MapObject& object);
py::object ToPython(const MapPart& part);
py::object ToPython(const MapChanges& changes);
py::object ToPython(const FilterReport& filter);
py::object ToPython(const BaSummary& summary);
py::object ToPython(const LoopSearchSummary& summary);
py::object ToPython(const ImprovementProbability& improvement);
py::object ToPython(const NoiseScale& scale);
py::object ToPython(const AsyncReport& report);
py::object ToPython(const PoseGraph& graph);
py::object ToPython(const std::map<std::string, StageTimes>& timing);
py::object ToPython(const Trajectory& trajectory, const std::vector<int>& frames);

/// `kept` are the places in the frame of the detections that the filter has kept.
py::object ToPython(const FrameReport& report, const std::vector<int>& kept, std::size_t given);

template <class Items>
py::list ListOf(const Items& items) {
  py::list list;
  for (const auto& item : items) list.append(ToPython(item));
  return list;
}

}  // namespace sslcd::python
