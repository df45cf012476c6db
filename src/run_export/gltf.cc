// SPDX-License-Identifier: BSD-3-Clause
#include "run_export/gltf.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "formats/json_text.h"

namespace sslcd {
namespace {

using Json = GltfBuilder::Json;

// glTF 2.0, 5.1 and 5.24
constexpr int kFloat = 5126, kUnsignedInt = 5125, kArrayBuffer = 34962, kElementBuffer = 34963;
constexpr int kLines = 1, kLineStrip = 3;

// Bytes as the format wants them, the lowest one first.
void Append(std::uint32_t value, std::string& bytes) {
  for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(value >> shift & 0xff);
}

void Append(float value, std::string& bytes) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  Append(bits, bytes);
}

std::string Chunk(const char* kind, std::string content, char filler) {
  while (content.size() % 4 != 0) content += filler;
  std::string chunk;
  Append(static_cast<std::uint32_t>(content.size()), chunk);
  return chunk.append(kind, 4) + content;
}

double Linear(std::uint8_t value) {
  const double s = value / 255.;  // IEC 61966-2-1
  const double linear = s <= .04045 ? s / 12.92 : std::pow((s + .055) / 1.055, 2.4);
  return std::round(linear * 1e6) / 1e6;
}

Json MaterialOf(const std::string& name, Colour colour) {
  const Vec3 linear = LinearColour(colour);
  Json material;
  material["name"] = name;
  material["pbrMetallicRoughness"] = {{"baseColorFactor", {linear.x(), linear.y(), linear.z(), 1}},
                                      {"metallicFactor", 0},
                                      {"roughnessFactor", .9}};
  return material;
}

int Last(const Json& list) { return static_cast<int>(list.size()) - 1; }

}  // namespace

Vec3 LinearColour(Colour colour) {
  return Vec3(Linear(colour.red), Linear(colour.green), Linear(colour.blue));
}

int GltfBuilder::AddNode(Json node) {
  nodes_.push_back(std::move(node));
  return Last(nodes_);
}

int GltfBuilder::AddMaterial(const std::string& name, Colour colour) {
  materials_.push_back(MaterialOf(name, colour));
  return Last(materials_);
}

int GltfBuilder::AddLineMaterial(const std::string& name, Colour colour) {
  Json material = MaterialOf(name, colour);
  material["extensions"]["KHR_materials_unlit"] = Json::object();
  materials_.push_back(std::move(material));
  return Last(materials_);
}

int GltfBuilder::AddSolid(const Solid& solid, int material) {
  std::vector<Vec3> corners, normals;
  std::vector<int> triangles;
  for (const std::vector<int>& face : solid.faces) {
    const Vec3 &a = solid.corners[face[0]], &b = solid.corners[face[1]],
               &c = solid.corners[face[2]];
    const int first = static_cast<int>(corners.size());
    for (const int corner : face) {
      corners.push_back(solid.corners[corner]);
      normals.push_back((b - a).cross(c - b).normalized());
    }
    for (int i = 2; i < static_cast<int>(face.size()); ++i)
      triangles.insert(triangles.end(), {first, first + i - 1, first + i});
  }
  Json primitive;
  primitive["attributes"]["POSITION"] = AddVectors(corners, true);
  primitive["attributes"]["NORMAL"] = AddVectors(normals, false);
  primitive["indices"] = AddIndices(triangles);
  return AddMesh(std::move(primitive), material);
}

int GltfBuilder::AddPath(std::vector<Vec3> points, int material) {
  if (points.size() == 1) points.push_back(points[0]);
  Json primitive;
  primitive["attributes"]["POSITION"] = AddVectors(points, true);
  primitive["mode"] = kLineStrip;
  return AddMesh(std::move(primitive), material);
}

int GltfBuilder::AddLines(const std::vector<Vec3>& points, const std::vector<Colour>& colours,
                          int material) {
  std::vector<Vec3> linear;
  for (const Colour colour : colours) linear.insert(linear.end(), 2, LinearColour(colour));
  Json primitive;
  primitive["attributes"]["POSITION"] = AddVectors(points, true);
  primitive["attributes"]["COLOR_0"] = AddVectors(linear, false);
  primitive["mode"] = kLines;
  return AddMesh(std::move(primitive), material);
}

int GltfBuilder::AddVectors(const std::vector<Vec3>& vectors, bool with_range) {
  const std::size_t start = binary_.size();
  // the range is that of the rounded numbers
  Eigen::Vector3f low = Eigen::Vector3f::Constant(INFINITY), high = -low;
  for (const Vec3& vector : vectors) {
    const Eigen::Vector3f rounded = vector.cast<float>();
    for (int axis = 0; axis < 3; ++axis) Append(rounded[axis], binary_);
    low = low.cwiseMin(rounded);
    high = high.cwiseMax(rounded);
  }
  Json accessor = {{"componentType", kFloat}, {"type", "VEC3"}, {"count", vectors.size()}};
  if (with_range) {
    accessor["min"] = {low.x(), low.y(), low.z()};
    accessor["max"] = {high.x(), high.y(), high.z()};
  }
  return AddAccessor(std::move(accessor), start, kArrayBuffer);
}

int GltfBuilder::AddIndices(const std::vector<int>& indices) {
  const std::size_t start = binary_.size();
  for (const int index : indices) Append(static_cast<std::uint32_t>(index), binary_);
  return AddAccessor(
      {{"componentType", kUnsignedInt}, {"type", "SCALAR"}, {"count", indices.size()}}, start,
      kElementBuffer);
}

int GltfBuilder::AddAccessor(Json accessor, std::size_t start, int target) {
  views_.push_back({{"buffer", 0},
                    {"byteOffset", start},
                    {"byteLength", binary_.size() - start},
                    {"target", target}});
  accessor["bufferView"] = Last(views_);
  accessors_.push_back(std::move(accessor));
  return Last(accessors_);
}

int GltfBuilder::AddMesh(Json primitive, int material) {
  primitive["material"] = material;
  Json mesh;
  mesh["primitives"] = Json::array({std::move(primitive)});
  meshes_.push_back(std::move(mesh));
  return Last(meshes_);
}

std::string GltfBuilder::Bytes() const {
  Json root;
  root["asset"] = {{"version", "2.0"}, {"generator", "sslcd"}};
  root["extensionsUsed"] = {"KHR_materials_unlit"};
  root["scene"] = 0;
  root["scenes"] = Json::array({{{"nodes", {0}}}});
  root["nodes"] = nodes_;
  root["meshes"] = meshes_;
  root["materials"] = materials_;
  root["accessors"] = accessors_;
  root["bufferViews"] = views_;
  root["buffers"] = Json::array({{{"byteLength", binary_.size()}}});
  const std::string chunks =
      Chunk("JSON", JsonText(root, root["nodes"]), ' ') + Chunk("BIN\0", binary_, '\0');
  std::string bytes = "glTF";
  Append(std::uint32_t{2}, bytes);
  Append(static_cast<std::uint32_t>(12 + chunks.size()), bytes);
  return bytes + chunks;
}

}  // namespace sslcd
