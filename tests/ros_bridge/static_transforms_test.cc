// SPDX-License-Identifier: BSD-3-Clause
#include "ros_bridge/static_transforms.h"

#include <gtest/gtest.h>

namespace sslcd::ros_bridge {
namespace {

TEST(StaticTransforms, ComposesUpAndDown) {
  StaticTransforms tree;
  const Pose T_base_mast = Pose::Trans(0, 0, 1) * Pose::RotZ(1);
  const Pose T_mast_cam = Pose::Trans(0.1, 0, 0) * Pose::RotX(-0.3);
  const Pose T_base_lidar = Pose::Trans(0.5, 0, 0.7);
  EXPECT_TRUE(tree.Add("base_link", "mast", T_base_mast));
  EXPECT_TRUE(tree.Add("mast", "/camera", T_mast_cam)) << "a leading slash, as before tf2";
  EXPECT_TRUE(tree.Add("/base_link", "lidar", T_base_lidar));
  const auto expect = [&](const char* a, const char* b, const Pose& pose) {
    const auto found = tree.Find(a, b);
    ASSERT_TRUE(found) << a << b;
    EXPECT_LT((found->inverse() * pose).Log().norm(), 1e-12) << a << b;
  };
  expect("base_link", "camera", T_base_mast * T_mast_cam);
  expect("/camera", "base_link", (T_base_mast * T_mast_cam).inverse());
  expect("lidar", "camera", T_base_lidar.inverse() * T_base_mast * T_mast_cam);
  expect("camera", "camera", Pose());
}

TEST(StaticTransforms, SaysWhatItDoesNotKnow) {
  StaticTransforms tree;
  tree.Add("base_link", "camera", Pose());
  EXPECT_FALSE(tree.Find("base_link", "gps"));
  EXPECT_FALSE(tree.Find("gps", "camera"));
  EXPECT_TRUE(tree.Find("gps", "gps")) << "a frame in itself needs no tree";
}

TEST(StaticTransforms, RefusesCyclesAndEmptyNames) {
  StaticTransforms tree;
  EXPECT_TRUE(tree.Add("a", "b", Pose()));
  EXPECT_TRUE(tree.Add("b", "c", Pose()));
  EXPECT_FALSE(tree.Add("c", "a", Pose()));
  EXPECT_FALSE(tree.Add("a", "a", Pose()));
  EXPECT_FALSE(tree.Add("", "d", Pose()));
  EXPECT_FALSE(tree.Add("a", "/", Pose()));
  EXPECT_TRUE(tree.Find("a", "c"));
}

TEST(StaticTransforms, TheLatestCounts) {
  StaticTransforms tree;
  tree.Add("a", "b", Pose::Trans(1, 0, 0));
  tree.Add("a", "b", Pose::Trans(2, 0, 0));
  EXPECT_EQ(tree.Find("a", "b")->translation().x(), 2);
}

}  // namespace
}  // namespace sslcd::ros_bridge
