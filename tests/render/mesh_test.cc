// SPDX-License-Identifier: BSD-3-Clause
#include "render/mesh.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "render/car_shape.h"
#include "render/tree_and_pole.h"
#include "sim/halv.h"

namespace sslcd::render {
namespace {

struct Extent {
  Vec3f low = Vec3f::Constant(1e9f), high = Vec3f::Constant(-1e9f);
};
Extent ExtentOf(const Mesh& mesh) {
  Extent extent;
  for (const Vec3f& point : mesh.points) {
    extent.low = extent.low.cwiseMin(point);
    extent.high = extent.high.cwiseMax(point);
  }
  return extent;
}

TEST(Mesh, BoxFacesOutwards) {
  Mesh mesh;
  AddBox(mesh, {-1, -2, -3}, {1, 2, 3}, 0);
  ComputeNormals(mesh);
  ASSERT_EQ(mesh.triangles.size(), 12u);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    EXPECT_GT(mesh.normals[i][0].dot(mesh.points[mesh.triangles[i][0]]), 0.9f);
}

TEST(Mesh, RoundThingsHaveRoundNormalsAndSharpEdges) {
  Mesh mesh;
  AddCone(mesh, {{0, 0, 0}, 1}, {{0, 0, 2}, 1}, 24, 0);
  ComputeNormals(mesh);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (int corner = 0; corner < 3; ++corner) {
      const Vec3f& point = mesh.points[mesh.triangles[i][corner]];
      const Vec3f& normal = mesh.normals[i][corner];
      EXPECT_NEAR(normal.norm(), 1, 1e-5);
      if (std::abs(normal.z()) < 0.5f) {
        EXPECT_NEAR(normal.dot(Vec3f(point.x(), point.y(), 0)), 1, 1e-3);
      } else {
        EXPECT_NEAR(std::abs(normal.z()), 1, 1e-5);
      }
    }
  }
}

TEST(Mesh, EveryVehicleFillsItsCuboidAndStandsOnItsWheels) {
  for (const char* layout : {"lot", "street"}) {
    sim::HalvScene scene;
    scene.layout = layout;
    for (const sim::WorldObject& object : sim::MakeHalvWorld(3, scene).world.objects) {
      const Vec3f dims = object.dims.cast<float>();
      const Mesh mesh = IsVehicle(object)        ? MakeCarMesh(MakeCarShape(object, object.id))
                        : object.label == "Tree" ? MakeTreeMesh(dims, object.id)
                                                 : MakePoleMesh(dims);
      const Extent extent = ExtentOf(mesh);
      const float slack = 1e-3f;
      for (int axis : {0, 1}) {
        EXPECT_GE(extent.low[axis], -0.5f * dims[axis] - slack) << object.label << " " << object.id;
        EXPECT_LE(extent.high[axis], 0.5f * dims[axis] + slack) << object.label << " " << object.id;
        EXPECT_GE((extent.high - extent.low)[axis],
                  (object.label == "Tree" ? 0.6f : 0.95f) * dims[axis]);
      }
      EXPECT_NEAR(extent.low.z(), 0, 0.01) << object.label;
      EXPECT_LE(extent.high.z(), dims.z() + slack) << object.label;
      EXPECT_GE(extent.high.z(), 0.85f * dims.z()) << object.label;
    }
  }
}

TEST(Mesh, VehiclesAreClosedAndFaceOutwards) {
  sim::WorldObject object;
  object.dims = {4.4, 1.8, 1.6};
  for (const char* label : {"Car", "Van", "Truck"}) {
    object.label = label;
    const Mesh mesh = MakeCarMesh(MakeCarShape(object, 1));
    // of the tetrahedra from the origin to each triangle; positive where these face outwards
    double volume = 0;
    for (const auto& [a, b, c] : mesh.triangles)
      volume += mesh.points[a].dot(mesh.points[b].cross(mesh.points[c])) / 6;
    EXPECT_GT(volume, 0.4 * object.dims.prod()) << label;
    EXPECT_LT(volume, 0.9 * object.dims.prod()) << label;
  }
}

TEST(Mesh, CarsDiffer) {
  sim::WorldObject object;
  object.label = "Car";
  object.dims = {4.2, 1.8, 1.5};
  const CarShape a = MakeCarShape(object, 1), b = MakeCarShape(object, 2),
                 again = MakeCarShape(object, 1);
  EXPECT_NE(a.roof_rear, b.roof_rear);
  EXPECT_EQ(a.roof_rear, again.roof_rear);
}

}  // namespace
}  // namespace sslcd::render
