// SPDX-License-Identifier: BSD-3-Clause
#include "render/mesh.h"

#include <Eigen/Geometry>
#include <cstddef>

namespace sslcd::render {

int Mesh::AddPoint(const Vec3f& point) {
  points.push_back(point);
  return static_cast<int>(points.size()) - 1;
}

void Mesh::AddTriangle(int a, int b, int c, int part) {
  triangles.push_back({a, b, c});
  parts.push_back(part);
}

void Mesh::AddQuad(int a, int b, int c, int d, int part) {
  AddTriangle(a, b, c, part);
  AddTriangle(a, c, d, part);
}

void AddQuad(Mesh& mesh, const Vec3f& a, const Vec3f& b, const Vec3f& c, const Vec3f& d, int part) {
  const int first = mesh.AddPoint(a);
  for (const Vec3f& point : {b, c, d}) mesh.AddPoint(point);
  mesh.AddQuad(first, first + 1, first + 2, first + 3, part);
}

void AddBox(Mesh& mesh, const Vec3f& low, const Vec3f& high, int part) {
  const auto corner = [&](int x, int y, int z) {
    return Vec3f(x ? high.x() : low.x(), y ? high.y() : low.y(), z ? high.z() : low.z());
  };
  AddQuad(mesh, corner(0, 0, 0), corner(0, 1, 0), corner(1, 1, 0), corner(1, 0, 0), part);
  AddQuad(mesh, corner(0, 0, 1), corner(1, 0, 1), corner(1, 1, 1), corner(0, 1, 1), part);
  AddQuad(mesh, corner(0, 0, 0), corner(1, 0, 0), corner(1, 0, 1), corner(0, 0, 1), part);
  AddQuad(mesh, corner(0, 1, 0), corner(0, 1, 1), corner(1, 1, 1), corner(1, 1, 0), part);
  AddQuad(mesh, corner(0, 0, 0), corner(0, 0, 1), corner(0, 1, 1), corner(0, 1, 0), part);
  AddQuad(mesh, corner(1, 0, 0), corner(1, 1, 0), corner(1, 1, 1), corner(1, 0, 1), part);
}

void AddCone(Mesh& mesh, const Disc& from, const Disc& to, int sides, int part) {
  const Vec3f axis = (to.centre - from.centre).normalized(), across = axis.unitOrthogonal(),
              other = axis.cross(across);
  const int first = static_cast<int>(mesh.points.size());
  for (int side = 0; side < sides; ++side) {
    const float angle =
        2 * static_cast<float>(M_PI) * static_cast<float>(side) / static_cast<float>(sides);
    const Vec3f out = std::cos(angle) * across + std::sin(angle) * other;
    mesh.AddPoint(from.centre + from.radius * out);
    mesh.AddPoint(to.centre + to.radius * out);
  }
  const int bottom = mesh.AddPoint(from.centre), top = mesh.AddPoint(to.centre);
  for (int side = 0; side < sides; ++side) {
    const int a = first + 2 * side, b = first + 2 * ((side + 1) % sides);
    mesh.AddQuad(a, b, b + 1, a + 1, part);
    mesh.AddTriangle(b, a, bottom, part);
    mesh.AddTriangle(a + 1, b + 1, top, part);
  }
}

void ComputeNormals(Mesh& mesh, float crease_rad) {
  const std::size_t count = mesh.triangles.size();
  std::vector<Vec3f> faces(count);
  std::vector<std::vector<int>> around(mesh.points.size());
  for (std::size_t i = 0; i < count; ++i) {
    const auto& [a, b, c] = mesh.triangles[i];
    // as long as twice its area
    faces[i] = (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]);
    for (int corner : mesh.triangles[i]) around[corner].push_back(static_cast<int>(i));
  }
  const float limit = std::cos(crease_rad);
  mesh.normals.assign(count, {});
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3f own = faces[i].stableNormalized();
    for (int corner = 0; corner < 3; ++corner) {
      Vec3f sum = Vec3f::Zero();
      for (int other : around[mesh.triangles[i][corner]]) {
        if (faces[other].dot(own) >= limit * faces[other].norm()) sum += faces[other];
      }
      mesh.normals[i][corner] = sum.norm() > 1e-12f ? Vec3f(sum.normalized()) : own;
    }
  }
}

}  // namespace sslcd::render
