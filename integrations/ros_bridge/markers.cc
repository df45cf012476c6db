// SPDX-License-Identifier: BSD-3-Clause
#include "ros_bridge/markers.h"

#include <cstddef>

namespace sslcd::ros_bridge {
namespace {

// Colours that differ well (Okabe and Ito, 2008), without black.
constexpr std::array<std::array<float, 3>, 7> kColours{{{0.90f, 0.62f, 0.00f},
                                                        {0.34f, 0.71f, 0.91f},
                                                        {0.00f, 0.62f, 0.45f},
                                                        {0.94f, 0.89f, 0.26f},
                                                        {0.00f, 0.45f, 0.70f},
                                                        {0.84f, 0.37f, 0.00f},
                                                        {0.80f, 0.47f, 0.65f}}};

std::array<float, 4> ColourOf(const std::string& label) {
  std::size_t sum = 0;  // the same on every machine, unlike std::hash
  for (const char letter : label) sum = 31 * sum + static_cast<unsigned char>(letter);
  const auto& [red, green, blue] = kColours[sum % kColours.size()];
  return {red, green, blue, 0.8f};
}

}  // namespace

std::vector<Marker> ObjectMarkers(const std::vector<MapObject>& objects) {
  std::vector<Marker> markers;
  for (const MapObject& object : objects) {
    if (object.state != LandmarkState::kConfirmed) continue;
    Marker marker;
    marker.name_space = object.label;
    marker.id = object.id.value;
    marker.pose = object.T_world_object;
    marker.scale = object.dims;
    marker.colour = ColourOf(object.label);
    markers.push_back(std::move(marker));
  }
  return markers;
}

Marker LoopMarker(const std::vector<PathPose>& path, const std::map<int, LoopEdge>& loops) {
  std::map<int, Vec3> positions;
  for (const PathPose& pose : path) positions[pose.frame] = pose.T_map_base.translation();
  Marker marker;
  marker.name_space = "loops";
  marker.type = Marker::Type::kLines;
  marker.scale = Vec3(0.1, 0, 0);
  marker.colour = {0.84f, 0.37f, 0.00f, 1.f};
  for (const auto& [id, loop] : loops) {
    const auto match = positions.find(loop.match_frame), query = positions.find(loop.query_frame);
    if (match == positions.end() || query == positions.end()) continue;
    marker.points.push_back(match->second);
    marker.points.push_back(query->second);
  }
  return marker;
}

}  // namespace sslcd::ros_bridge
