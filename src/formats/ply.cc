// SPDX-License-Identifier: BSD-3-Clause
#include "formats/ply.h"

#include "formats/number_text.h"

namespace sslcd {

std::string PlyText(const MapFile& map, const Trajectory& trajectory) {
  // Corner i of a cuboid: bit 0 front, bit 1 left, bit 2 top.
  constexpr int kFaces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  std::string vertices, faces;
  int count = 0, face_count = 0;
  for (const MapObject& object : map.objects) {
    if (object.state != LandmarkState::kConfirmed) continue;
    for (int i = 0; i < 8; ++i) {
      const Vec3 corner(i & 1 ? 0.5 : -0.5, i & 2 ? 0.5 : -0.5, i & 4 ? 0.5 : -0.5);
      const Vec3 p = object.T_world_object * Vec3(corner.cwiseProduct(object.dims));
      for (int axis = 0; axis < 3; ++axis) vertices += FixedNumber(p[axis], 4) + " ";
      vertices += "70 130 180\n";
    }
    for (const auto& face : kFaces) {
      faces += "4";
      for (const int corner : face) faces += " " + std::to_string(count + corner);
      faces += "\n";
      ++face_count;
    }
    count += 8;
  }
  for (const Pose& T : trajectory.poses) {
    for (int axis = 0; axis < 3; ++axis) vertices += FixedNumber(T.translation()[axis], 4) + " ";
    vertices += "220 50 47\n";
    ++count;
  }
  return "ply\nformat ascii 1.0\nelement vertex " + std::to_string(count) +
         "\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\nproperty "
         "uchar green\n"
         "property uchar blue\nelement face " +
         std::to_string(face_count) + "\nproperty list uchar int vertex_indices\nend_header\n" +
         vertices + faces;
}

}  // namespace sslcd
