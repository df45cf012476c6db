// SPDX-License-Identifier: BSD-3-Clause
#include "mapper.h"

#include <pybind11/stl.h>

#include <optional>

#include "bindings.h"
#include "configuration.h"
#include "frames.h"
#include "results.h"
#include "sslcd/core/timing.h"

namespace sslcd::python {
namespace {

py::object AddFrame(MapperInTurn& self, const py::handle& given) {
  const Frame frame = FrameFrom(given);
  const FrameReport report = self.AddFrame(frame);
  return ToPython(report, KeptOf(frame, self.filter()), frame.detections.size());
}

// Converts the result of a member function of Mapper.
template <class Result>
auto Get(Result (Mapper::*get)() const) {
  return [get](MapperInTurn& self) {
    return ToPython(self.Do([get](const Mapper& mapper) { return (mapper.*get)(); }));
  };
}
template <class Item>
auto GetList(std::vector<Item> (Mapper::*get)() const) {
  return [get](MapperInTurn& self) {
    return ListOf(self.Do([get](const Mapper& mapper) { return (mapper.*get)(); }));
  };
}

py::object GetTrajectory(MapperInTurn& self) {
  const auto [trajectory, frames] = self.NumberedTrajectory();
  return ToPython(trajectory, frames);
}

std::optional<int> Current(MapperInTurn& self, int id) {
  const auto current =
      self.Do([id](const Mapper& mapper) { return mapper.Current(LandmarkId{id}); });
  return current ? std::optional<int>(current->value) : std::nullopt;
}

}  // namespace

void BindMapper(py::module_& module) {
  py::class_<MapperInTurn>(module, "Mapper")
      .def(py::init([](const std::vector<std::string>& settings, const py::dict& context) {
             return std::make_unique<MapperInTurn>(OptionsFrom(settings), ContextFrom(context));
           }),
           py::arg("settings"), py::arg("context"))
      .def("add_frame", &AddFrame, py::arg("frame"))
      .def("start_sequence",
           [](MapperInTurn& self) { self.Do([](Mapper& mapper) { mapper.StartSequence(); }); })
      .def("take_changes",
           [](MapperInTurn& self) {
             return ToPython(self.Do([](Mapper& mapper) { return mapper.TakeChanges(); }));
           })
      .def(
          "refine",
          [](MapperInTurn& self, bool at_end) {
            const Refinement when = at_end ? Refinement::kAtEnd : Refinement::kOnTheWay;
            return ToPython(self.Do([when](Mapper& mapper) { return mapper.Refine(when); }));
          },
          py::arg("at_end"))
      .def("copy", &MapperInTurn::Copy)
      .def("current", &Current, py::arg("id"))
      .def("trajectory", &GetTrajectory)
      .def("objects", GetList(&Mapper::Objects))
      .def("loops", GetList(&Mapper::LoopClosures))
      .def("parts", GetList(&Mapper::Parts))
      .def("graph", Get(&Mapper::Graph))
      .def("loop_search", Get(&Mapper::SummariseLoopSearch))
      .def("improvement", Get(&Mapper::improvement))
      .def("noise_scale", Get(&Mapper::noise_scale))
      .def("scale",
           [](MapperInTurn& self) {
             return self.Do([](const Mapper& mapper) { return mapper.scale(); });
           })
      .def("timing", [](MapperInTurn& self) {
        return ToPython(self.Do([](Mapper& mapper) { return mapper.timing().Summary(); }));
      });
}

}  // namespace sslcd::python
