// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl.h>

#include <future>
#include <limits>

#include "arrays.h"
#include "bindings.h"
#include "configuration.h"
#include "frames.h"
#include "mapper.h"
#include "results.h"
#include "ros_bridge/bridge.h"
#include "ros_bridge/markers.h"
#include "sslcd/core/error.h"
#include "waiting.h"

namespace sslcd::python {
namespace {

using namespace py::literals;
using Values = std::map<std::string, std::string>;

// Position and orientation (x y z w).
using RawValues = std::pair<std::array<double, 3>, std::array<double, 4>>;
// Hypotheses (label, score), pose, size.
using RawDetection =
    std::tuple<std::vector<std::pair<std::string, double>>, RawValues, std::array<double, 3>>;

ros_bridge::RawPose PoseOf(const RawValues& values) { return {values.first, values.second}; }

// A Bridge for recordings: no frame is dropped, since no one waits for it.
class RecordedBridge {
 public:
  RecordedBridge(const ros_bridge::BridgeOptions& options, const Options& mapper,
                 const MapperContext& context)
      : bridge_(options, mapper, context), filter_(mapper.filter) {}

  void AddTransform(const std::string& parent, const std::string& child, const RawValues& pose) {
    bridge_.Add(ros_bridge::TransformMessage{parent, child, PoseOf(pose)});
  }
  void AddOdometry(std::int64_t stamp, const Values& frames, const RawValues& pose,
                   const std::array<double, 36>& covariance) {
    bridge_.Add(ros_bridge::OdometryMessage{stamp, frames.at("frame"), frames.at("child_frame"),
                                            PoseOf(pose), covariance});
  }
  void AddDetections(std::int64_t stamp, const std::string& frame,
                     const std::vector<RawDetection>& detections) {
    ros_bridge::DetectionsMessage message{stamp, frame, {}};
    for (const auto& [hypotheses, pose, size] : detections) {
      ros_bridge::DetectionMessage detection;
      for (const auto& [label, score] : hypotheses) detection.hypotheses.push_back({label, score});
      detection.pose = PoseOf(pose);
      detection.size = size;
      message.detections.push_back(detection);
    }
    bridge_.Add(message);
  }
  py::dict Finish();

 private:
  ros_bridge::Bridge bridge_;
  DetectionFilterOptions filter_;
};

py::list EdgesOf(const std::map<int, ros_bridge::LoopEdge>& loops) {
  py::list edges;
  for (const auto& [id, loop] : loops)
    edges.append(py::dict("id"_a = id, "match_frame"_a = loop.match_frame,
                          "query_frame"_a = loop.query_frame, "match_stamp"_a = loop.match,
                          "query_stamp"_a = loop.query,
                          "T_match_query"_a = ToArray(loop.measured.T_a_b),
                          "covariance"_a = ToArray(loop.measured.covariance)));
  return edges;
}

// Fields of visualization_msgs/Marker.
py::dict MarkerToPython(const ros_bridge::Marker& marker) {
  const Eigen::Quaterniond q = marker.pose.unit_quaternion();
  const Vec3& t = marker.pose.translation();
  py::list points;
  for (const Vec3& point : marker.points)
    points.append(py::make_tuple(point.x(), point.y(), point.z()));
  return py::dict("ns"_a = marker.name_space, "id"_a = marker.id,
                  "lines"_a = marker.type == ros_bridge::Marker::Type::kLines,
                  "position"_a = py::make_tuple(t.x(), t.y(), t.z()),
                  "orientation"_a = py::make_tuple(q.x(), q.y(), q.z(), q.w()),
                  "scale"_a = py::make_tuple(marker.scale.x(), marker.scale.y(), marker.scale.z()),
                  "colour"_a = marker.colour, "points"_a = points);
}

py::dict RecordedBridge::Finish() {
  bridge_.Refine();
  std::future<Mapper> future = bridge_.Snapshot();
  WaitFor([&](double seconds) {
    return future.wait_for(std::chrono::duration<double>(seconds)) == std::future_status::ready;
  });
  const ros_bridge::BridgeReport report = bridge_.Take();
  if (!report.failure.empty()) throw Error(ErrorKind::kNoSolution, report.failure);
  Mapper mapper = future.get();
  const std::vector<ros_bridge::PathPose> path = bridge_.path();
  py::list markers;
  for (const ros_bridge::Marker& marker : ros_bridge::ObjectMarkers(mapper.Objects()))
    markers.append(MarkerToPython(marker));
  markers.append(MarkerToPython(ros_bridge::LoopMarker(path, bridge_.loops())));
  std::vector<int> frames;
  for (const ros_bridge::PathPose& pose : path) frames.push_back(pose.frame);
  py::dict made(
      "frames"_a = Column<int>(frames, [](int frame) { return frame; }),
      "stamps"_a = Column<std::int64_t>(path, [](const auto& pose) { return pose.stamp; }),
      "poses"_a = Stack<4, 4>(path, [](const auto& pose) { return pose.T_map_base.matrix(); }),
      "loops"_a = EdgesOf(bridge_.loops()), "markers"_a = markers,
      "drops"_a = bridge_.drops().Text(), "odom_frame"_a = bridge_.odom_frame(),
      "base_frame"_a = bridge_.base_frame(), "camera_frame"_a = bridge_.camera_frame());
  made["mapper"] =
      py::cast(std::make_unique<MapperInTurn>(std::move(mapper), std::move(frames), filter_));
  return made;
}

std::unique_ptr<RecordedBridge> MakeBridge(const Values& frames, bool body_axes,
                                           const std::vector<std::string>& settings,
                                           const py::dict& context) {
  ros_bridge::BridgeOptions options;
  options.odom_frame = frames.at("odom_frame");
  options.base_frame = frames.at("base_frame");
  options.camera_frame = frames.at("camera_frame");
  options.body_axes = body_axes;
  options.most_frames = options.most_waiting = std::numeric_limits<int>::max();
  return std::make_unique<RecordedBridge>(options, OptionsFrom(settings), ContextFrom(context));
}

}  // namespace

void BindRosBridge(py::module_& module) {
  py::class_<RecordedBridge>(module, "RosBridge")
      .def(py::init(&MakeBridge), py::arg("frames"), py::arg("body_axes"), py::arg("settings"),
           py::arg("context"))
      .def("add_transform", &RecordedBridge::AddTransform, py::arg("parent"), py::arg("child"),
           py::arg("pose"))
      .def("add_odometry", &RecordedBridge::AddOdometry, py::arg("stamp"), py::arg("frames"),
           py::arg("pose"), py::arg("covariance"))
      .def("add_detections", &RecordedBridge::AddDetections, py::arg("stamp"), py::arg("frame"),
           py::arg("detections"))
      .def("finish", &RecordedBridge::Finish);
}

}  // namespace sslcd::python
