// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl.h>

#include <string>
#include <vector>

#include "bindings.h"
#include "frames.h"
#include "in_turn.h"
#include "map_export/export_map.h"
#include "map_results.h"
#include "results.h"
#include "sslcd/core/error.h"
#include "sslcd/pipeline/localiser.h"
#include "store/site.h"

namespace sslcd::python {
namespace {

// Opens a map and asks it, without the GIL.
template <class Ask>
auto AskMap(const std::string& path, const Ask& ask) {
  const py::gil_scoped_release release;
  const MapStore store(path);
  return ask(store);
}

MapInfo InfoOf(const std::string& path) {
  return AskMap(path, [](const MapStore& store) { return store.Describe(); });
}

py::object Results(const std::string& path) {
  const auto [results, info] = AskMap(
      path, [](const MapStore& store) { return std::pair(store.Results(), store.Describe()); });
  return ToPython(results, info);
}

py::list Frames(const std::string& path, const std::string& session) {
  py::list frames;
  for (const Frame& frame :
       AskMap(path, [&](const MapStore& store) { return store.Frames(session); }))
    frames.append(ToPython(frame));
  return frames;
}

py::object Compare(const std::string& path, const std::string& before, const std::string& after) {
  const auto [diff, info] = AskMap(path, [&](const MapStore& store) {
    MapInfo described = store.Describe();
    return std::pair(CompareSessions(described, store.History(), before, after), described);
  });
  return ToPython(diff, info);
}

std::vector<std::string> Export(const std::string& path, const std::string& folder) {
  return AskMap(path, [&](const MapStore& store) {
    return ExportMap(store.Describe(), store.Results(), folder);
  });
}

// `progress` may be None. ctrl-C ends it, and the map stays as it was.
py::object Merge(const std::string& into, const std::vector<std::string>& from,
                 const std::string& out, bool rename, bool refine_once,
                 const py::object& progress) {
  MergeRequest request{into, from, out, rename, refine_once, {}};
  request.progress = [&progress](int done, int total) {
    const py::gil_scoped_acquire acquire;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (!progress.is_none()) progress(done, total);
    return true;
  };
  MergeReport report;
  {
    const py::gil_scoped_release release;
    report = MergeMaps(request);
  }
  return ToPython(report);
}

// A Localiser, and what frames have to agree with.
struct MapLocaliser {
  Localiser localiser;
  std::string path;
  MapInfo info;

  std::optional<Localisation> AddFrame(const Frame& frame) {
    CheckVectorLengths(info, path, frame);
    return localiser.AddFrame(frame);
  }
};
using LocaliserInTurn = InTurn<MapLocaliser>;

// `belongs`: whether the context has to be that of the map, but for the camera.
std::unique_ptr<LocaliserInTurn> MakeLocaliser(const std::string& path, const py::dict& given,
                                               bool belongs) {
  const MapperContext context = ContextFrom(given);
  const py::gil_scoped_release release;
  const MapStore store(path);
  const MapInfo info = store.Describe();
  if (belongs) CheckBelongs(info, path, {context.gravity, context.labels, {}}, std::nullopt);
  return std::make_unique<LocaliserInTurn>(MapLocaliser{
      Localiser(store.Reference(), OptionsOf(info, path), context.camera), path, info});
}

void BindLocaliser(py::module_& module) {
  py::class_<LocaliserInTurn>(module, "Localiser")
      .def(py::init(&MakeLocaliser), py::arg("path"), py::arg("context"), py::arg("belongs"))
      .def(
          "add_frame",
          [](LocaliserInTurn& self, const py::object& given) -> py::object {
            const Frame frame = FrameFrom(given);
            const auto found = self.Do([&](MapLocaliser& one) { return one.AddFrame(frame); });
            return found ? ToPython(*found) : py::none();
          },
          py::arg("frame"))
      .def("attempt", [](LocaliserInTurn& self) {
        return ToPython(self.Do([](MapLocaliser& one) { return one.localiser.Attempt(); }));
      });
}

py::object Between(const MapHistory& self, int place, int before, int after) {
  const std::vector<PlaceHistory>& places = self.places();
  const int count = static_cast<int>(places.size());
  const int sessions = count > 0 ? static_cast<int>(places[0].sessions.size()) : 0;
  if (place < 0 || place >= count || before < 0 || before >= after || after >= sessions)
    throw Error(ErrorKind::kUsage, "place " + std::to_string(place) + ", sessions " +
                                       std::to_string(before) + " and " + std::to_string(after) +
                                       ": there are " + std::to_string(count) + " places and " +
                                       std::to_string(sessions) +
                                       " sessions, and the earlier session comes first");
  return ToPython(self.Between(place, before, after));
}

void BindHistory(py::module_& module) {
  py::class_<MapHistory>(module, "MapHistory")
      .def(py::init([](const std::string& path) {
             return AskMap(path, [](const MapStore& store) { return store.History(); });
           }),
           py::arg("path"))
      .def("places",
           [](const MapHistory& self) {
             py::list places;
             for (const PlaceHistory& place : self.places()) places.append(ToPython(place));
             return places;
           })
      .def("rates",
           [](const MapHistory& self) {
             py::dict rates;
             for (const auto& [label, rate] : self.rates()) rates[Text(label)] = ToPython(rate);
             return rates;
           })
      .def("between", &Between, py::arg("place"), py::arg("before"), py::arg("after"));
}

}  // namespace

void BindMaps(py::module_& module) {
  module.def("has_map", &HasMap, py::arg("path"));
  module.def(
      "map_info", [](const std::string& path) { return ToPython(InfoOf(path)); }, py::arg("path"));
  module.def("map_results", &Results, py::arg("path"));
  module.def("map_frames", &Frames, py::arg("path"), py::arg("session"));
  module.def(
      "verify_map",
      [](const std::string& path) {
        return AskMap(path, [](const MapStore& store) { return store.Verify(); });
      },
      py::arg("path"));
  module.def("compare_sessions", &Compare, py::arg("path"), py::arg("before"), py::arg("after"));
  module.def("export_map", &Export, py::arg("path"), py::arg("folder"));
  module.def("merge_maps", &Merge, py::arg("into"), py::arg("others"), py::arg("out"),
             py::arg("rename"), py::arg("refine_once"), py::arg("progress"));
  module.def(
      "compact_map",
      [](const std::string& path) {
        const py::gil_scoped_release release;
        CompactMap(path);
      },
      py::arg("path"));
  BindHistory(module);
  BindLocaliser(module);
}

}  // namespace sslcd::python
