// SPDX-License-Identifier: BSD-3-Clause
#include "formats/map_json.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "formats/json.h"
#include "formats/json_text.h"

namespace sslcd {
namespace {

using Json = nlohmann::ordered_json;

template <class Values>
Json ListOf(const Values& values, int size) {
  Json list = Json::array();
  for (int i = 0; i < size; ++i) list.push_back(values[i]);
  return list;
}

Json JsonOf(const MapObject& object) {
  Json json;
  json["id"] = object.id.value;
  json["label"] = object.label;
  json["state"] = ToString(object.state);
  json["pose_world_object"] = ListOf(object.T_world_object.data(), 7);
  json["dimensions_lwh"] = ListOf(object.dims, 3);
  Json& observations = json["observations"] = Json::array();
  for (const auto& observation : object.observations)
    observations.push_back(Json::array({observation.frame, observation.detection_row}));
  return json;
}

LandmarkState StateOf(const JsonValue& value) {
  for (const LandmarkState state : {LandmarkState::kTentative, LandmarkState::kConfirmed,
                                    LandmarkState::kDynamic, LandmarkState::kStale}) {
    if (value.Text() == ToString(state)) return state;
  }
  value.Fail("unknown state '" + value.Text() + "'");
}

MapObject ObjectOf(const JsonValue& json) {
  MapObject object;
  object.id.value = json.Child("id").Integer();
  object.label = json.Child("label").Text();
  object.state = StateOf(json.Child("state"));
  const std::vector<double> pose = json.Child("pose_world_object").Numbers(7);
  std::copy(pose.begin(), pose.end(), object.T_world_object.data());
  const double length = std::hypot(std::hypot(pose[0], pose[1]), std::hypot(pose[2], pose[3]));
  if (!(std::abs(length - 1) <= kRotationTolerance))
    json.Child("pose_world_object").Fail("pose_world_object: expected a quaternion of length 1");
  object.T_world_object.normalise();
  object.dims = Vec3(json.Child("dimensions_lwh").Numbers(3).data());
  if (!(object.dims.minCoeff() > 0)) json.Fail("dimensions_lwh: expected lengths above 0");
  for (const JsonValue& pair : json.Child("observations").List()) {
    if (pair.List().size() != 2) pair.Fail("an observation is a pair [frame, detection_row]");
    object.observations.push_back({pair.items[0].Integer(), pair.items[1].Integer()});
  }
  return object;
}

}  // namespace

std::string MapJson(const MapFile& map) {
  Json root;
  root["format"] = "sslcd-map";
  root["version"] = 1;
  root["up_axis"] = ListOf(map.up_axis, 3);
  Json& objects = root["objects"] = Json::array();
  for (const MapObject& object : map.objects) objects.push_back(JsonOf(object));
  return JsonText(root, objects);
}

MapFile ReadMapJson(const std::string& path) {
  const JsonValue root = ReadJson(path);
  if (root.Child("format").Text() != "sslcd-map") root.Fail("this is not an sslcd map");
  const int version = root.Child("version").Integer();
  if (version != 1)
    root.Fail("version " + std::to_string(version) +
              " of the map format; this program reads version 1");
  MapFile map;
  map.up_axis = Vec3(root.Child("up_axis").Numbers(3).data());
  if (!(std::abs(map.up_axis.norm() - 1) < 1e-3))
    root.Child("up_axis").Fail("up_axis: expected a unit vector");
  std::set<int> ids;
  for (const JsonValue& object : root.Child("objects").List()) {
    map.objects.push_back(ObjectOf(object));
    if (!ids.insert(map.objects.back().id.value).second)
      object.Child("id").Fail("id " + std::to_string(map.objects.back().id.value) + " twice");
  }
  return map;
}

}  // namespace sslcd
