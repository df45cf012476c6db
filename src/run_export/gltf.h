// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "formats/colour.h"
#include "formats/solid.h"

namespace sslcd {

/// Builds a binary glTF 2.0 file (.glb). Functions that add something return its index. The caller
/// makes the nodes; the first one is the root of the scene.
class GltfBuilder {
 public:
  using Json = nlohmann::ordered_json;

  Json& nodes() { return nodes_; }
  int AddNode(Json node);

  int AddMaterial(const std::string& name, Colour colour);
  /// Of lines, which no light shades.
  int AddLineMaterial(const std::string& name, Colour colour);
  /// The solid with flat faces.
  int AddSolid(const Solid& solid, int material);
  /// Points in order, joined by a line. Of one point: a line of no length.
  int AddPath(std::vector<Vec3> points, int material);
  /// A line from each point of even index to the next one, with a colour for each line.
  int AddLines(const std::vector<Vec3>& points, const std::vector<Colour>& colours, int material);

  std::string Bytes() const;

 private:
  int AddVectors(const std::vector<Vec3>& vectors, bool with_range);
  int AddIndices(const std::vector<int>& indices);
  int AddAccessor(Json accessor, std::size_t start, int target);
  int AddMesh(Json primitive, int material);

  std::string binary_;
  Json nodes_ = Json::array(), meshes_ = Json::array(), materials_ = Json::array(),
       accessors_ = Json::array(), views_ = Json::array();
};

/// Red, green and blue of sRGB as linear numbers in [0, 1], to 6 decimals.
Vec3 LinearColour(Colour colour);

}  // namespace sslcd
