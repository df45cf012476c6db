// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "render/noise.h"
#include "render/surface.h"

namespace sslcd::render {
namespace {

constexpr float kFine = 0.005f;

/// Share of the surfaces with the property `is` among the triangles that `which` selects.
template <class Which, class Is>
double Share(const CarShape& shape, const Vec3f& paint, Which which, Is is) {
  const Mesh mesh = MakeCarMesh(shape);
  double all = 0, found = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& [a, b, c] = mesh.triangles[i];
    const Vec3f edges = (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]);
    const Vec3f normal = mesh.normals[i][0];
    if (!which(mesh.parts[i], normal)) continue;
    Draws draw(static_cast<std::uint32_t>(i));
    for (int k = 0; k < 20; ++k) {
      const float u = draw(0, 1), v = draw(0, 1 - u);
      const Vec3f at = (1 - u - v) * mesh.points[a] + u * mesh.points[b] + v * mesh.points[c];
      const Surface surface = CarSurface(shape, paint, {at, normal, mesh.parts[i], kFine});
      all += edges.norm();
      if (is(surface)) found += edges.norm();
    }
  }
  return found / all;
}

CarShape ShapeOf(const char* label, const Vec3& dims, std::uint32_t seed) {
  sim::WorldObject object;
  object.label = label;
  object.dims = dims;
  return MakeCarShape(object, seed);
}

bool IsGlassy(const Surface& surface) {
  return surface.reflectivity > 0.08f && surface.albedo.maxCoeff() < 0.06f;
}
bool IsRed(const Surface& surface) {
  return surface.albedo.x() > 0.2f && surface.albedo.y() < 0.05f;
}
bool IsBlue(const Surface& surface) { return surface.albedo.z() > 2 * surface.albedo.x() + 0.05f; }

TEST(CarSurface, EveryCarHasPaintWindowsAndTailLamps) {
  const Vec3f blue(0.1f, 0.2f, 0.7f);
  const auto sides = [](int part, const Vec3f&) { return part == kCarSide || part == kCarTop; };
  const auto rear = [](int part, const Vec3f& normal) {
    return part <= kCarRear && normal.x() < -0.6f;
  };
  for (std::uint32_t seed = 1; seed <= 12; ++seed) {
    for (const Vec3& dims : {Vec3(3.6, 1.6, 1.5), Vec3(4.5, 1.8, 1.45), Vec3(4.6, 1.8, 1.7)}) {
      const CarShape shape = ShapeOf("Car", dims, seed);
      const double glass = Share(shape, blue, sides, IsGlassy),
                   paint = Share(shape, blue, sides, IsBlue);
      EXPECT_GT(glass, 0.1) << seed;
      EXPECT_LT(glass, 0.5) << seed;
      EXPECT_GT(paint, 0.4) << seed;
      EXPECT_GT(Share(shape, blue, rear, IsRed), 0.02) << seed;
      EXPECT_LT(Share(shape, blue, rear, IsRed), 0.3) << seed;
    }
  }
}

TEST(CarSurface, TyresAreBlackAndRimsAreNot) {
  const CarShape shape = ShapeOf("Car", {4.2, 1.75, 1.5}, 1);
  const Vec3f hub(shape.front_axle, 0.5f * shape.width, shape.wheel_radius), left = Vec3f::UnitY();
  const auto at = [&](float up) {
    return CarSurface(shape, Vec3f::Ones(), {hub + up * Vec3f::UnitZ(), left, kCarWheel, kFine})
        .albedo.mean();
  };
  EXPECT_GT(at(0), 0.1f);
  EXPECT_LT(at(0.9f * shape.wheel_radius), 0.05f);
}

TEST(CarSurface, PlatesTellCarsApart) {
  const auto plate = [](std::uint32_t seed) {
    const CarShape shape = ShapeOf("Truck", {5, 2, 2.6}, seed);
    std::vector<bool> dark;
    for (float y = -0.25f; y < 0.25f; y += 0.005f) {
      const Surface surface =
          CarSurface(shape, Vec3f::Ones(), {{-2.5f, y, 0.95f}, {-1, 0, 0}, kCarBox, kFine});
      dark.push_back(surface.albedo.y() < 0.3f);
    }
    return dark;
  };
  EXPECT_EQ(plate(1), plate(1));
  EXPECT_NE(plate(1), plate(2));
}

}  // namespace
}  // namespace sslcd::render
