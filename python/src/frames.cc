// SPDX-License-Identifier: BSD-3-Clause
#include "frames.h"

#include <pybind11/stl.h>

#include <cmath>

#include "arrays.h"
#include "place_matcher.h"
#include "sslcd/core/error.h"

namespace sslcd::python {
namespace {

using namespace py::literals;
using Floats = py::array_t<float, py::array::c_style | py::array::forcecast>;

constexpr double kUnit = 1e-6;  // float32 vectors that differ less from length 1 are left alone
constexpr std::pair<Cue, const char*> kCues[] = {{Cue::kColour, "colours"},
                                                 {Cue::kEmbedding, "embeddings"}};

py::object Attribute(const py::handle& object, const char* name) { return object.attr(name); }

std::optional<StepUncertainty> StepFrom(const py::object& step) {
  if (step.is_none()) return std::nullopt;
  if (py::isinstance<py::str>(step)) return StepUncertainty{true};
  const auto sigmas = step.cast<std::pair<double, double>>();
  return StepUncertainty{false, sigmas.first, sigmas.second};
}

py::object StepToPython(const std::optional<StepUncertainty>& step) {
  if (!step) return py::none();
  if (step->lost) return py::str("lost");
  return py::make_tuple(step->translation_m, step->rotation_rad);
}

// As the reader of embeddings.npy does, but a vector that is not finite stays, so that the library
// counts its detection as invalid.
std::vector<float> UnitVector(const float* values, py::ssize_t size) {
  std::vector<float> vector(values, values + size);
  double squares = 0;
  for (const float value : vector) squares += double(value) * value;
  if (squares == 0) return {};
  if (std::abs(squares - 1) > kUnit)
    for (float& value : vector) value = static_cast<float>(value / std::sqrt(squares));
  return vector;
}

void SetBoxes(const py::object& given, std::vector<Detection>& detections) {
  if (given.is_none()) return;
  const Array boxes = given.cast<Array>();
  for (std::size_t i = 0; i < detections.size(); ++i) {
    const double* b = boxes.data(static_cast<py::ssize_t>(i), 0);
    const Box2d box{b[0], b[1], b[2], b[3]};
    if (box.Area() > 0) detections[i].box = box;  // NaN is not above zero
  }
}

void SetAppearance(const py::object& given, Cue cue, std::vector<Detection>& detections) {
  if (given.is_none()) return;
  const Floats vectors = given.cast<Floats>();
  for (std::size_t i = 0; i < detections.size(); ++i)
    detections[i].appearance[cue] =
        UnitVector(vectors.data(static_cast<py::ssize_t>(i), 0), vectors.shape(1));
}

// [N, D]; None if no detection has a vector.
py::object VectorsOf(const std::vector<Detection>& detections, Cue cue) {
  std::size_t size = 0;
  for (const Detection& d : detections) size = std::max(size, d.appearance[cue].size());
  if (size == 0) return py::none();
  py::array_t<float> array(std::vector<std::size_t>{detections.size(), size});
  float* row = array.mutable_data();
  std::fill_n(row, detections.size() * size, 0.F);
  for (const Detection& d : detections) {
    std::copy(d.appearance[cue].begin(), d.appearance[cue].end(), row);
    row += size;
  }
  return std::move(array);
}

// [N, 4]; a row of NaN: none. None if no detection has a box.
py::object BoxesOf(const std::vector<Detection>& detections) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  bool any = false;
  Array array(std::vector<std::size_t>{detections.size(), 4});
  double* value = array.mutable_data();
  for (const Detection& d : detections) {
    any = any || d.box;
    const Box2d box = d.box.value_or(Box2d{kNone, kNone, kNone, kNone});
    for (const double side : {box.left, box.top, box.right, box.bottom}) *value++ = side;
  }
  return any ? py::object(std::move(array)) : py::none();
}

}  // namespace

Frame FrameFrom(const py::handle& given) {
  const py::object same = Attribute(given, "_same");
  if (!same.is_none()) return same.cast<Frame>();
  Frame frame;
  frame.index = Attribute(given, "index").cast<int>();
  frame.stamp = Attribute(given, "stamp").cast<double>();
  const std::string name = "frame " + std::to_string(frame.index) + ": ";
  frame.T_odom_cam =
      PoseFrom(Attribute(given, "T_odom_cam").cast<Array>().data(), name + "T_odom_cam");
  frame.step = StepFrom(Attribute(given, "step"));
  frame.image_left = Attribute(given, "image_left").cast<std::string>();
  frame.image_right = Attribute(given, "image_right").cast<std::string>();
  const auto labels = Attribute(given, "labels").cast<std::vector<std::string>>();
  const std::vector<Pose> poses =
      PosesFrom(Attribute(given, "poses").cast<Array>(), name + "poses");
  const Array dims = Attribute(given, "dims").cast<Array>();
  const Array scores = Attribute(given, "scores").cast<Array>();
  const auto rows = Attribute(given, "rows").cast<py::array_t<int>>();
  frame.detections.resize(labels.size());
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const auto row = static_cast<py::ssize_t>(i);
    Detection& detection = frame.detections[i];
    detection.row = rows.at(row);
    detection.label = labels[i];
    detection.score = scores.at(row);
    detection.T_cam_object = poses[i];
    detection.dims = Eigen::Map<const Vec3>(dims.data(row, 0));
  }
  SetBoxes(Attribute(given, "boxes"), frame.detections);
  for (const auto& [cue, attribute] : kCues)
    SetAppearance(Attribute(given, attribute), cue, frame.detections);
  return frame;
}

py::object ToPython(const Frame& frame) {
  const std::vector<Detection>& detections = frame.detections;
  py::dict fields("index"_a = frame.index, "stamp"_a = frame.stamp,
                  "T_odom_cam"_a = ToArray(frame.T_odom_cam), "boxes"_a = BoxesOf(detections),
                  "step"_a = StepToPython(frame.step), "image_left"_a = frame.image_left,
                  "image_right"_a = frame.image_right);
  py::list labels;
  for (const Detection& d : detections) labels.append(d.label);
  fields["labels"] = labels;
  fields["poses"] =
      Stack<4, 4>(detections, [](const Detection& d) { return d.T_cam_object.matrix(); });
  fields["dims"] = Stack<1, 3>(detections, [](const Detection& d) {
                     return d.dims.transpose();
                   }).reshape({static_cast<py::ssize_t>(detections.size()), py::ssize_t{3}});
  fields["scores"] = Column<double>(detections, [](const Detection& d) { return d.score; });
  fields["rows"] = Column<int>(detections, [](const Detection& d) { return d.row; });
  for (const auto& [cue, attribute] : kCues) fields[attribute] = VectorsOf(detections, cue);
  for (const auto& field : fields)
    if (py::isinstance<py::array>(field.second)) field.second.attr("setflags")("write"_a = false);
  const py::object made = py::module_::import("sslcd.inputs").attr("Frame")(**fields);
  py::module_::import("builtins")
      .attr("object")
      .attr("__setattr__")(made, "_same", py::cast(frame));
  return made;
}

std::vector<int> KeptOf(const Frame& frame, const DetectionFilterOptions& options) {
  std::vector<Detection> detections = frame.detections;
  for (std::size_t i = 0; i < detections.size(); ++i) detections[i].row = static_cast<int>(i);
  FilterDetections(detections, options);
  std::vector<int> kept;
  for (const Detection& detection : detections) kept.push_back(detection.row);
  return kept;
}

MapperContext ContextFrom(const py::dict& given) {
  MapperContext context;
  context.gravity = GravityFrame::FromUp(VectorFrom(given["up"].cast<Array>()));
  context.place_matcher = PlaceMatcherFrom(given["place_matcher"]);
  for (const auto& [label, symmetry] : given["labels"].cast<py::dict>()) {
    const auto name = symmetry.cast<std::string>();
    const std::optional<Symmetry> parsed = ParseSymmetry(name);
    if (!parsed)
      throw Error(ErrorKind::kUsage, "labels: " + label.cast<std::string>() +
                                         " has the symmetry '" + name +
                                         "', must be one of none, pi, full");
    context.labels.Set(label.cast<std::string>(), {*parsed});
  }
  const py::object camera = given["camera"];
  if (camera.is_none()) return context;
  Camera c;
  c.fx = camera.attr("fx").cast<double>();
  c.fy = camera.attr("fy").cast<double>();
  c.cx = camera.attr("cx").cast<double>();
  c.cy = camera.attr("cy").cast<double>();
  c.width = camera.attr("width").cast<int>();
  c.height = camera.attr("height").cast<int>();
  const auto offset = camera.attr("offset").cast<std::array<double, 3>>();
  c.offset = {offset[0], offset[1], offset[2]};
  context.camera = c;
  return context;
}

py::object ToPython(const std::optional<Camera>& camera) {
  if (!camera) return py::none();
  const Camera& c = *camera;
  return py::module_::import("sslcd.inputs")
      .attr("Camera")(c.fx, c.fy, c.cx, c.cy, c.width, c.height,
                      py::make_tuple(c.offset.x(), c.offset.y(), c.offset.z()));
}

}  // namespace sslcd::python
