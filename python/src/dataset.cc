// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/datasets/dataset.h"

#include <pybind11/stl.h>

#include "arrays.h"
#include "bindings.h"
#include "configuration.h"
#include "datasets/run_folder.h"
#include "formats/file_lock.h"
#include "frames.h"
#include "place_matcher.h"
#include "results.h"
#include "sslcd/core/error.h"
#include "sslcd/pipeline/run.h"
#include "sslcd/version.h"

namespace sslcd::python {
namespace {

ScoreKind ScoreFrom(const std::string& name) {
  if (name == "auto") return ScoreKind::kAuto;
  if (name == "probability") return ScoreKind::kProbability;
  if (name == "logit") return ScoreKind::kLogit;
  throw Error(ErrorKind::kUsage,
              "score is '" + name + "', must be one of auto, probability, logit");
}

// `parts` are the members of DatasetRequest.
Dataset Load(const std::string& path, const std::map<std::string, std::string>& parts,
             const std::string& score, int max_frames) {
  DatasetRequest request;
  request.path = path;
  request.format = parts.at("format");
  request.sequence = parts.at("sequence");
  request.detections = parts.at("detections");
  request.odometry = parts.at("odometry");
  request.groundtruth = parts.at("groundtruth");
  request.detection_options.score = ScoreFrom(score);
  request.max_frames = max_frames;
  const py::gil_scoped_release release;
  return LoadDataset(request);
}

py::object GroundTruth(const Dataset& dataset) {
  if (!dataset.groundtruth) return py::none();
  std::vector<int> rows(dataset.groundtruth->size());
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = static_cast<int>(i);
  return ToPython(*dataset.groundtruth, rows);
}

py::dict Labels(const Dataset& dataset) {
  py::dict labels;
  for (const auto& [label, info] : dataset.labels.entries())
    labels[py::str(label)] = ToString(info.symmetry);
  return labels;
}

void BindDataset(py::module_& module) {
  module.def("load_dataset", &Load, py::arg("path"), py::arg("parts"), py::arg("score"),
             py::arg("max_frames"));
  py::class_<Frame>(module, "Frame");
  py::class_<Dataset>(module, "Dataset")
      .def(
          "frame", [](const Dataset& d, std::size_t i) { return ToPython(d.frames.at(i)); },
          py::arg("i"))
      .def("__len__", [](const Dataset& d) { return d.frames.size(); })
      .def("labels", &Labels)
      .def("up", [](const Dataset& d) { return ToArray(d.up_axis); })
      .def("camera", [](const Dataset& d) { return ToPython(d.camera); })
      .def("groundtruth", &GroundTruth)
      .def_readonly("format", &Dataset::format)
      .def_readonly("name", &Dataset::name)
      .def_readonly("rows_read", &Dataset::rows_read)
      .def_readonly("rows_dropped", &Dataset::rows_dropped)
      .def_readonly("warnings", &Dataset::warnings);
}

// A run, and what is written beside its results.
struct Run {
  RunResult result;
  Vec3 up;
  std::string config_yaml;

  std::vector<std::string> Write(const std::string& folder) const {
    RunOutputs outputs;
    outputs.trajectory = result.trajectory;
    outputs.odometry = result.odometry;
    outputs.map = {up, result.objects};
    outputs.graph = result.graph;
    outputs.loops = result.loops;
    outputs.timing = result.timing;
    outputs.config_yaml = config_yaml;
    outputs.record.version = SSLCD_VERSION;
    outputs.record.commit = "unknown";
    outputs.record.complete = !result.stopped;
    const py::gil_scoped_release release;
    const FileLock lock = LockFolder(folder);
    return WriteRunFolder(folder, outputs);
  }
};

// Calls a function of Python's for an image of bytes [H, W, 3], blue green red.
bool UseImage(const py::object& load, const std::string& path,
              const std::function<void(const ImageView&)>& use) {
  const py::gil_scoped_acquire acquire;
  const py::object loaded = load(path);
  if (loaded.is_none()) return false;
  using Bytes = py::array_t<unsigned char, py::array::c_style>;
  if (!py::isinstance<Bytes>(loaded) || loaded.cast<Bytes>().ndim() != 3)
    throw Error(ErrorKind::kUsage,
                "load_image(" + path + ") returned no uint8 array [H, W, 3] in C order, nor None");
  const auto pixels = loaded.cast<Bytes>();
  use({pixels.data(), static_cast<int>(pixels.shape(1)), static_cast<int>(pixels.shape(0)),
       static_cast<std::size_t>(pixels.strides(0)), static_cast<int>(pixels.shape(2))});
  return true;
}

RunHooks HooksOf(const py::object& progress, const py::object& load_image) {
  RunHooks hooks;
  hooks.stop = [] {
    const py::gil_scoped_acquire acquire;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    return false;
  };
  if (!progress.is_none()) {
    hooks.progress = [&progress](int done, int total) {
      const py::gil_scoped_acquire acquire;
      progress(done, total);
    };
  }
  if (!load_image.is_none()) {
    hooks.with_image = [&load_image](const std::string& path, const auto& use) {
      return UseImage(load_image, path, use);
    };
  }
  return hooks;
}

Run RunDataset(const Dataset& dataset, const std::vector<std::string>& settings,
               const py::object& progress, const py::object& load_image,
               const py::object& place_matcher) {
  const Options options = OptionsFrom(settings);
  const MapperContext context{GravityFrame::FromUp(dataset.up_axis),
                              dataset.labels,
                              dataset.camera,
                              PlaceMatcherFrom(place_matcher),
                              {}};
  const RunHooks hooks = HooksOf(progress, load_image);
  const py::gil_scoped_release release;
  return {RunSequence(dataset.frames, context, options, hooks), dataset.up_axis,
          ConfigText(settings)};
}

void BindRun(py::module_& module) {
  module.def("run", &RunDataset, py::arg("dataset"), py::arg("settings"), py::arg("progress"),
             py::arg("load_image"), py::arg("place_matcher"));
  py::class_<Run>(module, "RunResult")
      .def("trajectory",
           [](const Run& run) { return ToPython(run.result.trajectory, run.result.frames); })
      .def("odometry",
           [](const Run& run) { return ToPython(run.result.odometry, run.result.frames); })
      .def("objects", [](const Run& run) { return ListOf(run.result.objects); })
      .def("loops", [](const Run& run) { return ListOf(run.result.loops); })
      .def("graph", [](const Run& run) { return ToPython(run.result.graph); })
      .def("noise_scale", [](const Run& run) { return ToPython(run.result.noise_scale); })
      .def("filter", [](const Run& run) { return ToPython(run.result.filter); })
      .def("refinement", [](const Run& run) { return ToPython(run.result.refinement); })
      .def("improvement", [](const Run& run) { return ToPython(run.result.improvement); })
      .def("timing", [](const Run& run) { return ToPython(run.result.timing.Summary()); })
      .def("scale", [](const Run& run) { return run.result.scale; })
      .def("images_failed", [](const Run& run) { return run.result.images_failed; })
      .def("write", &Run::Write, py::arg("folder"));
}

}  // namespace

void BindDatasets(py::module_& module) {
  BindDataset(module);
  BindRun(module);
}

}  // namespace sslcd::python
