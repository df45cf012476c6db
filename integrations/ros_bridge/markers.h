// SPDX-License-Identifier: BSD-3-Clause
// What RViz shows, as plain structs in the map frame: the fields of visualization_msgs/Marker.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "ros_bridge/bridge.h"

namespace sslcd::ros_bridge {

struct Marker {
  enum class Type { kCube, kLines };
  std::string name_space;  ///< the object's label, or "loops"
  int id = 0;
  Type type = Type::kCube;
  Pose pose;
  Vec3 scale{1, 1, 1};            ///< of a cube: its sides [m]; of lines: x is their width
  std::array<float, 4> colour{};  ///< red, green, blue, alpha in [0, 1]
  std::vector<Vec3> points;       ///< of lines: pairs
};

/// A cube for each confirmed object. A label always has the same colour.
std::vector<Marker> ObjectMarkers(const std::vector<MapObject>& objects);

/// One marker with a line from pose to pose for each accepted loop.
Marker LoopMarker(const std::vector<PathPose>& path, const std::map<int, LoopEdge>& loops);

}  // namespace sslcd::ros_bridge
