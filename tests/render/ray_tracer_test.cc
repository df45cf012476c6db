// SPDX-License-Identifier: BSD-3-Clause
#include "render/ray_tracer.h"

#include <gtest/gtest.h>

namespace sslcd::render {
namespace {

Mesh UnitBox() {
  Mesh mesh;
  AddBox(mesh, Vec3f::Zero(), Vec3f::Ones(), 3);
  ComputeNormals(mesh);
  return mesh;
}

TEST(RayTracer, FindsTheNearestAndWhatHides) {
  const RayTracer tracer({UnitBox()});
  const auto at = [](double x) { return Pose(lie::SO3<double>(), Vec3(x, 0, 0)); };
  const Scene scene = tracer.MakeScene({{0, at(5)}, {0, at(3)}});
  std::vector<Ray> rays(11, Ray{{0, 0.5f, 0.25f}, {2, 0, 0}, 100});  // more than a packet
  rays[9].direction = {-1, 0, 0};
  rays[10].far = 1;
  std::vector<Hit> hits;
  scene.Trace(rays, hits);
  ASSERT_EQ(hits.size(), rays.size());
  EXPECT_EQ(hits[0].instance, 1);
  EXPECT_NEAR(hits[0].distance, 1.5, 1e-6);
  EXPECT_EQ(hits[8].instance, 1);
  EXPECT_EQ(hits[9].instance, -1);
  EXPECT_EQ(hits[10].instance, -1);
  std::vector<char> hidden;
  scene.Hidden(rays, hidden);
  EXPECT_TRUE(hidden[8]);
  EXPECT_FALSE(hidden[9]);
  EXPECT_FALSE(hidden[10]);
}

TEST(RayTracer, NothingIsNothing) {
  const RayTracer tracer({});
  const Scene scene = tracer.MakeScene({});
  std::vector<Hit> hits;
  scene.Trace({}, hits);
  EXPECT_TRUE(hits.empty());
  scene.Trace({{{0, 0, 0}, {0, 0, 1}, 10}}, hits);
  EXPECT_EQ(hits[0].instance, -1);
}

TEST(RayTracer, TurnsMeshesAsTold) {
  const RayTracer tracer({UnitBox()});
  // now from x -1 to 0
  const Pose quarter(lie::SO3<double>::Exp(Vec3(0, 0, 0.5 * M_PI)), Vec3(0, 0, 0));
  const Scene scene = tracer.MakeScene({{0, quarter}});
  std::vector<Hit> hits;
  scene.Trace({{{-3, 0.5f, 0.5f}, {1, 0, 0}, 10}}, hits);
  EXPECT_NEAR(hits[0].distance, 2, 1e-5);
}

}  // namespace
}  // namespace sslcd::render
