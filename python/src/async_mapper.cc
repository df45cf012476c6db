// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/pipeline/async_mapper.h"

#include <pybind11/stl.h>

#include <future>
#include <memory>
#include <optional>
#include <utility>

#include "bindings.h"
#include "configuration.h"
#include "frames.h"
#include "mapper.h"
#include "results.h"
#include "sslcd/core/error.h"
#include "waiting.h"

namespace sslcd::python {
namespace {

// An AsyncMapper that can be closed. Other threads may still be in a call then, so each call keeps
// it alive.
class ClosableMapper {
 public:
  ClosableMapper(const Options& options, const MapperContext& context, int most_waiting,
                 double refine_every_m)
      : mapper_(new AsyncMapper(options, context, most_waiting, refine_every_m), &Delete),
        filter_(options.filter) {}
  ~ClosableMapper() { Close(); }

  void Close() { std::exchange(mapper_, nullptr).reset(); }
  bool closed() const { return mapper_ == nullptr; }
  std::shared_ptr<AsyncMapper> get() const {
    if (!mapper_) throw Error(ErrorKind::kUsage, "the AsyncMapper is closed");
    return mapper_;
  }
  const DetectionFilterOptions& filter() const { return filter_; }

 private:
  // Waits for its threads, which may need the GIL for a function of the host's.
  static void Delete(AsyncMapper* mapper) {
    std::optional<py::gil_scoped_release> release;
    if (PyGILState_Check() != 0) release.emplace();
    delete mapper;
  }

  std::shared_ptr<AsyncMapper> mapper_;
  DetectionFilterOptions filter_;
};

std::unique_ptr<MapperInTurn> Snapshot(const ClosableMapper& self) {
  const std::shared_ptr<AsyncMapper> mapper = self.get();
  std::future<Mapper> future = mapper->Snapshot();
  WaitFor([&](double seconds) {
    return future.wait_for(std::chrono::duration<double>(seconds)) == std::future_status::ready;
  });
  const py::gil_scoped_release release;
  try {
    Mapper copy = future.get();
    std::vector<int> frames;
    for (const PoseGraph::Vertex& vertex : copy.Graph().vertices) frames.push_back(vertex.id);
    return std::make_unique<MapperInTurn>(std::move(copy), std::move(frames), self.filter());
  } catch (const std::future_error&) {
    throw Error(ErrorKind::kNoSolution,
                "the mapper's thread has ended: take_report().failure says why");
  }
}

}  // namespace

void BindAsyncMapper(py::module_& module) {
  py::class_<ClosableMapper>(module, "AsyncMapper")
      .def(py::init([](const std::vector<std::string>& settings, const py::dict& context,
                       int most_waiting, double refine_every_m) {
             if (most_waiting < 1)
               throw Error(ErrorKind::kUsage,
                           "most_waiting is " + std::to_string(most_waiting) + ", must be above 0");
             return std::make_unique<ClosableMapper>(OptionsFrom(settings), ContextFrom(context),
                                                     most_waiting, refine_every_m);
           }),
           py::arg("settings"), py::arg("context"), py::arg("most_waiting"),
           py::arg("refine_every_m"))
      .def(
          "add_frame",
          [](const ClosableMapper& self, const py::object& frame) {
            return self.get()->AddFrame(FrameFrom(frame));
          },
          py::arg("frame"))
      .def("start_sequence", [](const ClosableMapper& self) { self.get()->StartSequence(); })
      .def(
          "refine",
          [](const ClosableMapper& self, bool at_end) {
            self.get()->Refine(at_end ? Refinement::kAtEnd : Refinement::kOnTheWay);
          },
          py::arg("at_end"))
      .def("snapshot", &Snapshot)
      .def("take_report",
           [](const ClosableMapper& self) { return ToPython(self.get()->TakeReport()); })
      .def("wait",
           [](const ClosableMapper& self) {
             const std::shared_ptr<AsyncMapper> mapper = self.get();
             WaitFor([&](double seconds) { return mapper->WaitFor(seconds); });
           })
      .def("close", &ClosableMapper::Close)
      .def("closed", &ClosableMapper::closed);
}

}  // namespace sslcd::python
