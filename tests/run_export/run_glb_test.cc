// SPDX-License-Identifier: BSD-3-Clause
#include "run_export/run_glb.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "small_run.h"

namespace sslcd {
namespace {

using Json = nlohmann::ordered_json;

std::string JsonChunk(const RunView& run) {
  const std::string bytes = RunGlb(SceneOf(run));
  return bytes.substr(20, bytes.find("BIN") - 24);
}

Json Parsed(const RunView& run) { return Json::parse(JsonChunk(run)); }

// Of the node with this name.
Json Node(const Json& glb, const std::string& name) {
  for (const Json& node : glb["nodes"])
    if (node["name"] == name) return node;
  ADD_FAILURE() << "no node " << name;
  return {};
}

TEST(RunGlb, UpIsYWhateverTheWorld) {
  const Vec3 ups[] = {Vec3(0, -1, 0), Vec3(0, 0, 1), Vec3(1, 0, 0)};
  for (const Vec3& up : ups) {
    const Json glb = Parsed(SmallRun(up)), car = Node(glb, "Car 12");
    EXPECT_EQ(car["translation"], Json({5., 0., -10.})) << "right, and ahead";
    EXPECT_EQ(car["scale"], Json({4., 2., 1.5}));
    const std::vector<double> q = car["rotation"];
    const Vec3 z = Eigen::Quaterniond(q[3], q[0], q[1], q[2]) * Vec3(0, 0, 1);
    EXPECT_LT((z - Vec3(0, 1, 0)).norm(), 1e-6);
    const Json& back = glb["nodes"][0]["extras"]["T_world_file"];
    const Vec3 start = SmallRun(up).trajectory.poses[0].translation();
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(back[axis][3], start[axis]);
      EXPECT_EQ(back[axis][1], up[axis]);
    }
  }
}

TEST(RunGlb, NodesHaveNames) {
  const Json glb = Parsed(SmallRun());
  EXPECT_EQ(glb["nodes"][0]["name"], "small");
  EXPECT_EQ(glb["nodes"][0]["children"].size(), 4u) << "objects, odometry, corrected, loops";
  EXPECT_EQ(Node(glb, "objects")["children"].size(), 2u) << "labels";
  EXPECT_EQ(Node(glb, "Tree<")["children"].size(), 1u);
  EXPECT_EQ(Node(glb, "Tree< 3")["extras"]["sightings"], 2);
  EXPECT_EQ(Node(glb, "loops")["extras"]["names"], Json::array({"loop 2 to 0"}));
}

TEST(RunGlb, NoObjectsAndNoLoopsNeedNoNodes) {
  RunView run = SmallRun();
  run.map.objects.clear();
  run.loops.clear();
  const Json glb = Parsed(run);
  EXPECT_EQ(glb["nodes"].size(), 3u);
  EXPECT_EQ(glb["nodes"][0]["children"], Json({1, 2}));
}

}  // namespace
}  // namespace sslcd
