// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/io/map_json.h"

#include <yaml-cpp/yaml.h>

#include "io/number_text.h"
#include "sslcd/core/error.h"
#include "sslcd/io/text_rows.h"

namespace sslcd {
namespace {

template <class Values>
std::string List(const Values& values, int size) {
  std::string text = "[";
  for (int i = 0; i < size; ++i) text += (i ? "," : "") + ShortestNumber(values[i]);
  return text + "]";
}

std::string Quoted(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + "\"";
}

// Every JSON file is a YAML file; yaml-cpp tells the line.
class Reader {
 public:
  explicit Reader(const std::string& path) : path_(path) {}

  [[noreturn]] void Fail(const YAML::Node& at, const std::string& message) const {
    const YAML::Mark mark = at.Mark();
    throw Error(ErrorKind::kBadInput, {path_, mark.is_null() ? 0 : mark.line + 1, 0}, message);
  }

  YAML::Node Child(const YAML::Node& parent, const char* key) const {
    if (!parent.IsMap()) Fail(parent, "expected an object with key '" + std::string(key) + "'");
    const YAML::Node child = parent[key];
    if (!child.IsDefined()) Fail(parent, "key '" + std::string(key) + "' is missing");
    return child;
  }

  double Number(const YAML::Node& node) const {
    const auto number = node.IsScalar() ? ParseNumber(node.Scalar()) : std::nullopt;
    if (!number) Fail(node, "expected a number");
    return *number;
  }

  template <class Out>
  void Numbers(const YAML::Node& parent, const char* key, int size, Out out) const {
    const YAML::Node list = Child(parent, key);
    if (!list.IsSequence() || static_cast<int>(list.size()) != size)
      Fail(list,
           "'" + std::string(key) + "' must be a list of " + std::to_string(size) + " numbers");
    for (int i = 0; i < size; ++i) out[i] = Number(list[i]);
  }

  MapObject Object(const YAML::Node& node) const {
    MapObject object;
    object.id.value = static_cast<int>(Number(Child(node, "id")));
    object.label = Child(node, "label").Scalar();
    const YAML::Node state = Child(node, "state");
    bool known = false;
    for (const LandmarkState s : {LandmarkState::kTentative, LandmarkState::kConfirmed,
                                  LandmarkState::kDynamic, LandmarkState::kStale}) {
      if (state.Scalar() != ToString(s)) continue;
      object.state = s;
      known = true;
    }
    if (!known) Fail(state, "unknown state '" + state.Scalar() + "'");
    double pose[7];
    Numbers(node, "pose_world_object", 7, pose);
    std::copy_n(pose, 7, object.T_world_object.data());
    object.T_world_object.normalise();
    Numbers(node, "dimensions_lwh", 3, object.dims.data());
    for (const YAML::Node& pair : Child(node, "observations")) {
      if (!pair.IsSequence() || pair.size() != 2)
        Fail(pair, "an observation is a pair [frame, detection_row]");
      object.observations.push_back(
          {static_cast<int>(Number(pair[0])), static_cast<int>(Number(pair[1]))});
    }
    return object;
  }

 private:
  std::string path_;
};

}  // namespace

std::string MapJson(const MapFile& map) {
  std::string text = "{\"format\":\"sslcd-map\",\"version\":1,\"up_axis\":" + List(map.up_axis, 3) +
                     ",\"objects\":[";
  bool first = true;
  for (const MapObject& object : map.objects) {
    text += (first ? "\n" : ",\n") + std::string("{\"id\":") + std::to_string(object.id.value);
    first = false;
    text += ",\"label\":" + Quoted(object.label) + ",\"state\":\"" + ToString(object.state) + "\"";
    text += ",\"pose_world_object\":" + List(object.T_world_object.data(), 7);
    text += ",\"dimensions_lwh\":" + List(object.dims, 3) + ",\"observations\":[";
    for (std::size_t i = 0; i < object.observations.size(); ++i)
      text += (i ? ",[" : "[") + std::to_string(object.observations[i].frame) + "," +
              std::to_string(object.observations[i].detection_row) + "]";
    text += "]}";
  }
  return text + "\n]}\n";
}

MapFile ReadMapJson(const std::string& path) {
  const Reader reader(path);
  YAML::Node root;
  try {
    root = YAML::Load(ReadFileBytes(path));
  } catch (const YAML::ParserException& problem) {
    throw Error(ErrorKind::kBadInput, {path, problem.mark.line + 1, problem.mark.column + 1},
                "not JSON: " + problem.msg);
  }
  if (reader.Child(root, "format").Scalar() != "sslcd-map")
    reader.Fail(root, "this is not an sslcd map");
  if (reader.Number(reader.Child(root, "version")) != 1)
    reader.Fail(root, "version " + root["version"].Scalar() +
                          " of the map format; this program reads version 1");
  MapFile map;
  reader.Numbers(root, "up_axis", 3, map.up_axis.data());
  for (const YAML::Node& object : reader.Child(root, "objects"))
    map.objects.push_back(reader.Object(object));
  return map;
}

}  // namespace sslcd
