// SPDX-License-Identifier: BSD-3-Clause
#include "formats/ply.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sslcd {
namespace {

TEST(PlyText, HasCuboidsOfConfirmedObjectsAndCameras) {
  MapFile map;
  map.objects.resize(2);
  map.objects[0].state = LandmarkState::kConfirmed;
  map.objects[0].dims = Vec3(4, 2, 1);
  map.objects[0].T_world_object = Pose::Trans(10, 0, 0);
  map.objects[1].state = LandmarkState::kDynamic;
  Trajectory trajectory;
  trajectory.poses = {Pose(), Pose::Trans(0, 0, 7)};
  const std::string text = PlyText(map, trajectory);
  EXPECT_THAT(text, testing::StartsWith("ply\nformat ascii 1.0\nelement vertex 10\n"));
  EXPECT_THAT(text, testing::HasSubstr("element face 6\n"));
  EXPECT_THAT(text, testing::HasSubstr("end_header\n8.0000 -1.0000 -0.5000 70 130 180\n"));
  EXPECT_THAT(text, testing::HasSubstr("\n0.0000 0.0000 7.0000 220 50 47\n4 0 2 3 1\n"));
  EXPECT_THAT(text, testing::EndsWith("\n4 1 3 7 5\n"));
}

TEST(PlyText, LinesAreEdgesWithTheirColours) {
  PlyMesh mesh;
  mesh.comments = {"metres"};
  mesh.AddLine({Vec3(0, 0, 0)}, {9, 9, 9});  // no edge
  mesh.AddLine({Vec3(1, 0, 0), Vec3(2, 0, 0), Vec3(3, 0, 0)}, {1, 2, 3});
  mesh.AddSolid(UnitBox(), Pose::Trans(5, 0, 0), Vec3(2, 2, 2), {4, 5, 6});
  const std::string text = PlyText(mesh);
  EXPECT_THAT(text,
              testing::StartsWith("ply\nformat ascii 1.0\ncomment metres\nelement vertex 12\n"));
  EXPECT_THAT(text,
              testing::HasSubstr("element edge 2\nproperty int vertex1\nproperty int vertex2\n"
                                 "property uchar red\n"));
  EXPECT_THAT(text, testing::HasSubstr("\n4.0000 -1.0000 -1.0000 4 5 6\n"));
  EXPECT_THAT(text, testing::HasSubstr("\n4 4 6 7 5\n")) << "faces count from their first corner";
  EXPECT_THAT(text, testing::EndsWith("\n1 2 1 2 3\n2 3 1 2 3\n"));
}

}  // namespace
}  // namespace sslcd
