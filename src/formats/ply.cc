// SPDX-License-Identifier: BSD-3-Clause
#include "formats/ply.h"

#include "formats/number_text.h"

namespace sslcd {
namespace {

std::string ColourText(Colour colour) {
  return std::to_string(colour.red) + " " + std::to_string(colour.green) + " " +
         std::to_string(colour.blue);
}

std::string Header(const PlyMesh& mesh) {
  const std::string colour = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  std::string text = "ply\nformat ascii 1.0\n";
  for (const std::string& comment : mesh.comments) text += "comment " + comment + "\n";
  text += "element vertex " + std::to_string(mesh.vertices.size()) +
          "\nproperty float x\nproperty float y\nproperty float z\n" + colour + "element face " +
          std::to_string(mesh.faces.size()) + "\nproperty list uchar int vertex_indices\n";
  if (!mesh.edges.empty())
    text += "element edge " + std::to_string(mesh.edges.size()) +
            "\nproperty int vertex1\nproperty int vertex2\n" + colour;
  return text + "end_header\n";
}

}  // namespace

void PlyMesh::AddSolid(const Solid& solid, const Pose& T_world_object, const Vec3& dims,
                       Colour colour) {
  const int first = static_cast<int>(vertices.size());
  for (const Vec3& corner : solid.corners)
    vertices.push_back({T_world_object * Vec3(corner.cwiseProduct(dims)), colour});
  for (std::vector<int> face : solid.faces) {
    for (int& corner : face) corner += first;
    faces.push_back(std::move(face));
  }
}

void PlyMesh::AddLine(const std::vector<Vec3>& points, Colour colour) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const int here = static_cast<int>(vertices.size());
    vertices.push_back({points[i], colour});
    if (i > 0) edges.push_back({here - 1, here, colour});
  }
}

std::string PlyText(const PlyMesh& mesh) {
  std::string text = Header(mesh);
  for (const PlyMesh::Vertex& vertex : mesh.vertices) {
    for (int axis = 0; axis < 3; ++axis) text += FixedNumber(vertex.position[axis], 4) + " ";
    text += ColourText(vertex.colour) + "\n";
  }
  for (const std::vector<int>& face : mesh.faces) {
    text += std::to_string(face.size());
    for (const int corner : face) text += " " + std::to_string(corner);
    text += "\n";
  }
  for (const PlyMesh::Edge& edge : mesh.edges)
    text += std::to_string(edge.from) + " " + std::to_string(edge.to) + " " +
            ColourText(edge.colour) + "\n";
  return text;
}

std::string PlyText(const MapFile& map, const Trajectory& trajectory) {
  PlyMesh mesh;
  const Solid box = UnitBox();
  for (const MapObject& object : map.objects)
    if (object.state == LandmarkState::kConfirmed)
      mesh.AddSolid(box, object.T_world_object, object.dims, {70, 130, 180});
  for (const Pose& T : trajectory.poses) mesh.vertices.push_back({T.translation(), {220, 50, 47}});
  return PlyText(mesh);
}

}  // namespace sslcd
