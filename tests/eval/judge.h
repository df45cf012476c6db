// SPDX-License-Identifier: BSD-3-Clause
// Runs the judges (tools/eval_map.py, tools/eval_sequence.py) and reads their one JSON object.
#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "outside.h"
#include "sslcd/core/detection.h"
#include "sslcd/core/landmark.h"

namespace sslcd::judge {

class Verdict {
 public:
  explicit Verdict(std::string json) : json_(std::move(json)) {}

  bool Has(const std::string& key) const {
    return json_.find("\"" + key + "\":") != std::string::npos;
  }

  /// The number behind a key, wherever it is nested; none for null and NaN.
  std::optional<double> operator[](const std::string& key) const {
    const std::size_t at = json_.find("\"" + key + "\":");
    if (at == std::string::npos) return std::nullopt;
    const std::string value = json_.substr(at + key.size() + 4, 3);
    if (value == "nul" || value == "NaN") return std::nullopt;
    return std::stod(json_.substr(at + key.size() + 3));
  }

 private:
  std::string json_;
};

/// Compares a value with the judge's, which is rounded to 4 digits.
inline void ExpectSame(const Verdict& verdict, const std::string& key, std::optional<double> ours) {
  EXPECT_TRUE(verdict.Has(key)) << key;
  const std::optional<double> theirs = verdict[key];
  ASSERT_EQ(theirs.has_value(), ours.has_value()) << key;
  if (ours.has_value()) {
    EXPECT_NEAR(*ours, *theirs, 1e-4) << key;
  }
}

inline std::string MapJson(const std::vector<MapObject>& objects) {
  std::ostringstream json;
  json.precision(17);
  json << R"({"format":"sslcd-map","version":1,"up_axis":[0,-1,0],"objects":[)";
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const MapObject& o = objects[i];
    json << (i > 0 ? ",\n" : "\n") << "{\"id\":" << o.id.value << ",\"label\":\"" << o.label
         << "\",\"state\":\"" << ToString(o.state) << "\",\"pose_world_object\":[";
    for (int k = 0; k < 7; ++k) json << (k > 0 ? "," : "") << o.T_world_object.data()[k];
    json << "],\"dimensions_lwh\":[" << o.dims[0] << "," << o.dims[1] << "," << o.dims[2]
         << "],\"observations\":[";
    for (std::size_t k = 0; k < o.observations.size(); ++k) {
      json << (k > 0 ? "," : "") << "[" << o.observations[k].frame << ","
           << o.observations[k].detection_row << "]";
    }
    json << "]}";
  }
  json << "]}\n";
  return json.str();
}

/// A simple map with errors: each detection joins the nearest object within the gate, and an object
/// is the mean of its detections.
inline std::vector<MapObject> ClusterDetections(const std::vector<Frame>& frames,
                                                const std::vector<Pose>& T_world_cam,
                                                double min_score, double gate_m) {
  const GravityFrame gravity;
  std::vector<MapObject> objects;
  for (const Frame& frame : frames) {
    if (frame.index >= static_cast<int>(T_world_cam.size())) continue;
    for (const Detection& detection : frame.detections) {
      if (detection.score < min_score) continue;
      const Pose T = T_world_cam[frame.index] * detection.T_cam_object;
      MapObject* nearest = nullptr;
      double nearest_m = gate_m;
      for (MapObject& object : objects) {
        const double distance = (object.T_world_object.translation() - T.translation()).norm();
        if (distance < nearest_m) {
          nearest = &object;
          nearest_m = distance;
        }
      }
      if (nearest == nullptr) {
        nearest = &objects.emplace_back();
        nearest->id = {static_cast<int>(objects.size())};
        nearest->label = detection.label;
        nearest->T_world_object = T;
      }
      nearest->observations.push_back({frame.index, detection.row});
      const double weight = 1. / static_cast<double>(nearest->observations.size());
      const Vec3 mean =
          nearest->T_world_object.translation() * (1 - weight) + T.translation() * weight;
      nearest->T_world_object = Pose(gravity.Upright(gravity.YawOf(T.so3())), mean);
      nearest->dims = nearest->dims * (1 - weight) + detection.dims * weight;
    }
  }
  for (MapObject& object : objects) {
    if (object.observations.size() > 2) object.state = LandmarkState::kConfirmed;
  }
  return objects;
}

}  // namespace sslcd::judge
