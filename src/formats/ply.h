// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "formats/colour.h"
#include "formats/map_json.h"
#include "formats/solid.h"
#include "sslcd/core/pose.h"

namespace sslcd {

/// A coloured mesh with edges.
struct PlyMesh {
  struct Vertex {
    Vec3 position;
    Colour colour;
  };
  struct Edge {
    int from = 0, to = 0;
    Colour colour;
  };
  std::vector<std::string> comments;  ///< one line each
  std::vector<Vertex> vertices;
  std::vector<std::vector<int>> faces;
  std::vector<Edge> edges;

  void AddSolid(const Solid& solid, const Pose& T_world_object, const Vec3& dims, Colour colour);
  /// Points in order, joined by edges.
  void AddLine(const std::vector<Vec3>& points, Colour colour);
};

/// Returns an ASCII PLY file. Coordinates have four decimals.
std::string PlyText(const PlyMesh& mesh);

/// Returns an ASCII PLY file with the cuboids of the confirmed objects (faces) and the camera
/// positions (points).
std::string PlyText(const MapFile& map, const Trajectory& trajectory);

}  // namespace sslcd
