// SPDX-License-Identifier: BSD-3-Clause
// All sizes [m], colours (linear red, green, blue) and frequencies [1/m] of this file were set by
// hand.
#include "render/tree_and_pole.h"

#include <Eigen/Geometry>

#include "render/noise.h"
#include "render/surface.h"

namespace sslcd::render {
Mesh MakeTreeMesh(const Vec3f& dims, std::uint32_t seed) {
  Draws draw(seed);
  Mesh mesh;
  const float height = dims.z(), radius = 0.5f * dims.x(), trunk = draw(0.24f, 0.34f) * height;
  AddCone(mesh, {{0, 0, 0}, 0.075f * radius + 0.05f}, {{0, 0, 0.85f * height}, 0.02f}, 9, kTrunk);
  constexpr int kClumps = 34, kLeaves = 40;
  for (int clump = 0; clump < kClumps; ++clump) {
    const float up = draw(0, 1), turn = draw(0, 6.283f);
    const float room =
        radius * std::sqrt(std::max(1 - std::pow(2 * up - 0.85f, 2.f) / 1.4f, 0.05f));
    const float size = draw(0.3f, 0.45f) * radius,
                out = std::max(room - size, 0.f) * std::sqrt(draw(0, 1));
    const Vec3f centre(out * std::cos(turn), out * std::sin(turn),
                       Mix(trunk + size, height - size, up));
    for (int leaf = 0; leaf < kLeaves; ++leaf) {
      Vec3f way{draw(-1, 1), draw(-1, 1), draw(-1, 1)};
      way *= size / std::max(way.norm(), 0.3f);
      const Vec3f normal =
          (way + size * Vec3f{draw(-0.7f, 0.7f), draw(-0.7f, 0.7f), draw(0, 1)}).normalized();
      const float half = draw(0.035f, 0.075f);
      const Vec3f across = half * normal.unitOrthogonal(),
                  along = 1.6f * half * normal.cross(across).normalized();
      Vec3f at = centre + way;
      at = at.cwiseMax(Vec3f(-radius + 0.15f, -radius + 0.15f, 0.15f))
               .cwiseMin(Vec3f(radius - 0.15f, radius - 0.15f, height - 0.15f));
      AddQuad(mesh, at - along, at + across, at + along, at - across, kLeaf);
    }
  }
  ComputeNormals(mesh);
  return mesh;
}

Mesh MakePoleMesh(const Vec3f& dims) {
  Mesh mesh;
  const float radius = 0.5f * dims.x(), height = dims.z();
  constexpr int kSides = 20;
  AddCone(mesh, {{0, 0, 0}, radius}, {{0, 0, 0.12f}, radius}, kSides, 0);
  AddCone(mesh, {{0, 0, 0.12f}, 0.72f * radius}, {{0, 0, height - 0.28f}, 0.6f * radius}, kSides,
          0);
  AddCone(mesh, {{0, 0, height - 0.28f}, 0.6f * radius}, {{0, 0, height - 0.06f}, radius}, kSides,
          1);
  AddCone(mesh, {{0, 0, height - 0.06f}, radius}, {{0, 0, height}, 0.5f * radius}, kSides, 0);
  ComputeNormals(mesh);
  return mesh;
}

Surface PoleSurface(const Vec3f& paint, std::uint32_t seed, const SurfacePoint& point) {
  const float turn = std::atan2(point.position.y(), point.position.x());
  const float rust = Fractal(2 * turn, point.position.z(), seed, {2, 4}, point.footprint);
  if (point.part == 1) return {Vec3f(0.7f, 0.7f, 0.65f), 0.1f, 60, 1};
  const bool notice =
      std::abs(point.position.z() - 1.5f) < 0.16f && std::cos(turn - 6.28f * Unit(seed)) > 0.6f;
  if (notice) {
    const bool text = ValueNoise(turn * 9, point.position.z() * 60, seed) > 0.55f;
    return {text ? Vec3f(0.08f, 0.1f, 0.3f) : Vec3f(0.6f, 0.6f, 0.5f), 0.02f, 20, 2};
  }
  const int ring = Floor(4 * point.position.z());
  if (ring < 4 && Hash(seed) % 2) {  // a bumper guard, yellow and black
    const Vec3f colour = ring % 2 ? Vec3f(0.5f, 0.36f, 0.02f) : Vec3f(0.03f, 0.03f, 0.03f);
    return {Vec3f(colour * (1 + 0.25f * rust)), 0.03f, 30, 3 + ring};
  }
  return {Vec3f(Linear(paint) * (1 + 0.25f * rust)), 0.03f, 30, 0};
}

Surface WheelStopSurface(std::uint32_t seed, const SurfacePoint& point) {
  const float worn = Fractal(point.position.y(), point.position.x() + point.position.z(), seed,
                             {4, 6, 0.7f}, point.footprint);
  const bool yellow = Floor(point.position.y() / 0.3f) % 2 != 0 && worn < 0.25f && seed % 3 == 0;
  const Vec3f albedo = yellow ? Vec3f(0.5f, 0.36f, 0.04f) : Vec3f(0.3f, 0.29f, 0.27f);
  return {Vec3f(albedo * (1 + 0.35f * worn)), 0, 1, yellow, 0.6f};
}

Surface TreeSurface(const Vec3f& paint, std::uint32_t seed, const SurfacePoint& point) {
  if (point.part == kTrunk) {
    const float bark = Fractal(6 * std::atan2(point.position.y(), point.position.x()),
                               0.7f * point.position.z(), seed, {2, 4}, point.footprint);
    return {Vec3f(0.1f, 0.075f, 0.05f) * (1 + 0.5f * bark), 0, 1, 1, 0.7f};
  }
  const float tint =
      ValueNoise(point.position.x() * 6 + point.position.y() * 5, point.position.z() * 6, seed);
  const Vec3f season = Mix(Vec3f(1.15f, 1, 0.6f), Vec3f(0.8f, 1, 0.9f), Unit(Hash(seed, 3)));
  return {Vec3f((Linear(paint) * 1.25f).cwiseProduct(season) * (0.65f + 0.7f * tint)),
          0,
          10,
          2,
          0.55f + 0.3f * Clamp01(point.position.z() / 5),
          true};
}

}  // namespace sslcd::render
