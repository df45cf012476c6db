// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/store/map_session.h"

#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bindings.h"
#include "configuration.h"
#include "frames.h"
#include "in_turn.h"
#include "map_results.h"
#include "mapper.h"
#include "results.h"
#include "sslcd/core/error.h"
#include "sslcd/version.h"

namespace sslcd::python {
namespace {

// A MapSession that ends, after which its file is closed.
class ClosableSession {
 public:
  explicit ClosableSession(MapSession session)
      : session_(std::move(session)), filter_(get().options().filter) {}

  MapSession& get() {
    if (!session_) throw Error(ErrorKind::kUsage, "the session has been ended or closed");
    return *session_;
  }
  bool closed() const { return !session_; }
  void Close() { session_.reset(); }
  const DetectionFilterOptions& filter() const { return filter_; }

 private:
  std::optional<MapSession> session_;
  DetectionFilterOptions filter_;
};
using SessionInTurn = InTurn<ClosableSession>;

// `settings`: None for the options of the map, or the defaults of a new one.
std::unique_ptr<SessionInTurn> Begin(const std::string& path, const std::string& name,
                                     const std::string& dataset, const py::dict& given,
                                     const std::optional<std::vector<std::string>>& settings) {
  const MapperContext context = ContextFrom(given);
  std::optional<Options> options;
  if (settings) options = OptionsFrom(*settings);
  const py::gil_scoped_release release;
  return std::make_unique<SessionInTurn>(ClosableSession(MapSession::Begin(
      path, {name, dataset, "", std::string("Python package sslcd ") + SSLCD_VERSION}, context,
      options)));
}

std::unique_ptr<SessionInTurn> Resume(const std::string& path, const py::dict& given) {
  const MapperContext context = ContextFrom(given);
  const py::gil_scoped_release release;
  return std::make_unique<SessionInTurn>(ClosableSession(MapSession::Resume(path, context)));
}

py::object AddSessionFrame(SessionInTurn& self, const py::object& given) {
  const Frame frame = FrameFrom(given);
  const auto [report, filter] = self.Do([&](ClosableSession& session) {
    return std::pair(session.get().AddFrame(frame), session.filter());
  });
  return ToPython(report, KeptOf(frame, filter), frame.detections.size());
}

std::unique_ptr<MapperInTurn> MapperOf(SessionInTurn& self) {
  return self.Do([](ClosableSession& session) {
    const Mapper& mapper = session.get().mapper();
    std::vector<int> frames;
    for (const PoseGraph::Vertex& vertex : mapper.Graph().vertices) frames.push_back(vertex.id);
    return std::make_unique<MapperInTurn>(mapper, std::move(frames), session.filter());
  });
}

// Calls a function of a session that is open.
template <class Call>
auto Session(const Call& call) {
  return [call](SessionInTurn& self) {
    return self.Do([&](ClosableSession& session) { return call(session.get()); });
  };
}

}  // namespace

void BindMapSession(py::module_& module) {
  py::class_<SessionInTurn>(module, "MapSession")
      .def("add_frame", &AddSessionFrame, py::arg("frame"))
      .def(
          "is_stored",
          [](SessionInTurn& self, const py::object& given) {
            const Frame frame = FrameFrom(given);
            return self.Do([&](ClosableSession& one) { return one.get().IsStored(frame); });
          },
          py::arg("frame"))
      .def("start_sequence", Session([](MapSession& session) { session.StartSequence(); }))
      .def(
          "refine",
          [](SessionInTurn& self, bool at_end) {
            return ToPython(self.Do([at_end](ClosableSession& session) {
              return session.get().Refine(at_end ? Refinement::kAtEnd : Refinement::kOnTheWay);
            }));
          },
          py::arg("at_end"))
      .def("refines",
           Session([](const MapSession& session) { return session.options().refine.enabled; }))
      .def("save", Session([](MapSession& session) { session.Save(); }))
      .def("end",
           [](SessionInTurn& self) {
             self.Do([](ClosableSession& session) {
               session.get().End();
               session.Close();
             });
           })
      .def("close", [](SessionInTurn& self) { self.Do([](ClosableSession& one) { one.Close(); }); })
      .def("closed",
           [](SessionInTurn& self) {
             return self.Do([](ClosableSession& one) { return one.closed(); });
           })
      .def(
          "info",
          [](SessionInTurn& self) {
            return ToPython(self.Do([](ClosableSession& session) { return session.get().info(); }));
          })
      .def("stored_frames",
           Session([](const MapSession& session) { return session.stored_frames(); }))
      .def("mapper", &MapperOf);
  module.def("begin_session", &Begin, py::arg("path"), py::arg("name"), py::arg("dataset"),
             py::arg("context"), py::arg("settings"));
  module.def("resume_session", &Resume, py::arg("path"), py::arg("context"));
}

}  // namespace sslcd::python
