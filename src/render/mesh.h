// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "render/vectors.h"

namespace sslcd::render {

/// Triangles, each with a part number that selects its paint.
struct Mesh {
  std::vector<Vec3f> points;
  std::vector<std::array<int, 3>> triangles;
  std::vector<int> parts;
  /// at the corners of each triangle; see ComputeNormals
  std::vector<std::array<Vec3f, 3>> normals;

  int AddPoint(const Vec3f& point);
  void AddTriangle(int a, int b, int c, int part);
  void AddQuad(int a, int b, int c, int d, int part);  ///< counter-clockwise seen from outside
};

/// Adds faces with separate points, so that their edges stay sharp.
void AddQuad(Mesh& mesh, const Vec3f& a, const Vec3f& b, const Vec3f& c, const Vec3f& d, int part);
void AddBox(Mesh& mesh, const Vec3f& low, const Vec3f& high, int part);

/// One end of a cone: a disc perpendicular to the axis.
struct Disc {
  Vec3f centre;
  float radius = 0;  ///< [m]
};

/// Adds a closed truncated cone, whose sides share points for smooth shading.
void AddCone(Mesh& mesh, const Disc& from, const Disc& to, int sides, int part);

/// Computes the normal of each corner as the mean over the adjacent faces whose normals differ from
/// its own by at most `crease_rad`.
void ComputeNormals(Mesh& mesh, float crease_rad = 0.6f);

}  // namespace sslcd::render
