// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/io/run_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "sslcd/core/error.h"
#include "sslcd/io/atomic_file.h"
#include "sslcd/io/pose_reader.h"
#include "sslcd/io/text_rows.h"

namespace sslcd {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class RunFolder : public ::testing::Test {
 protected:
  void SetUp() override {
    folder =
        fs::path(::testing::TempDir()) /
        (std::string("sslcd_") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder);
    fs::create_directories(folder);
  }
  void TearDown() override { fs::remove_all(folder); }
  std::string In(const std::string& name) const { return (folder / name).string(); }
  fs::path folder;
};

Trajectory Path() {
  Trajectory trajectory;
  for (int i = 0; i < 5; ++i) {
    Vec6 xi;
    xi << i, -0.5 * i, 1e-12, 0.3 * i, 0.1, -0.7 * i;
    trajectory.stamps.push_back(0.1 * i);
    trajectory.poses.push_back(Pose::Exp(xi));
  }
  return trajectory;
}

MapFile SmallMap() {
  MapFile map;
  MapObject object;
  object.id = {7};
  object.label = "Car \"x\"";
  object.state = LandmarkState::kConfirmed;
  object.T_world_object = Path().poses[2];
  object.dims = Vec3(4.1, 1.6, 0.1 + 0.2);
  object.observations = {{3, 14}, {4, 20}};
  map.objects = {object, object};
  map.objects[1].id = {9};
  map.objects[1].state = LandmarkState::kDynamic;
  return map;
}

TEST_F(RunFolder, TrajectoriesReadBack) {
  const Trajectory path = Path();
  WriteFileAtomically(In("tum.txt"), TumText(path));
  WriteFileAtomically(In("kitti.txt"), KittiText(path));
  for (const char* name : {"tum.txt", "kitti.txt"}) {
    const Trajectory read = ReadTrajectory(In(name));
    ASSERT_EQ(read.size(), path.size());
    for (std::size_t i = 0; i < path.size(); ++i)
      EXPECT_LT((read.poses[i].inverse() * path.poses[i]).Log().norm(), 1e-7);
  }
  EXPECT_EQ(TumText(path).find(" \n"), std::string::npos)
      << "evo refuses a blank at the end of a row";
  EXPECT_EQ(TumText(path).find("-0.000000000"), std::string::npos);
}

TEST_F(RunFolder, MapReadsBackToTheBit) {
  const MapFile map = SmallMap();
  WriteFileAtomically(In("map.json"), MapJson(map));
  const MapFile read = ReadMapJson(In("map.json"));
  ASSERT_EQ(read.objects.size(), 2u);
  EXPECT_EQ(read.up_axis, map.up_axis);
  EXPECT_EQ(read.objects[0].label, map.objects[0].label);
  EXPECT_EQ(read.objects[0].dims, map.objects[0].dims);
  EXPECT_EQ(read.objects[0].observations[1].detection_row, 20);
  EXPECT_EQ(read.objects[1].state, LandmarkState::kDynamic);
  EXPECT_LT(
      (read.objects[0].T_world_object.translation() - map.objects[0].T_world_object.translation())
          .norm(),
      1e-15);
}

TEST_F(RunFolder, BadMapsAreRefusedWithTheirLine) {
  const auto error = [&](const std::string& text) -> std::string {
    WriteFileAtomically(In("map.json"), text);
    try {
      ReadMapJson(In("map.json"));
    } catch (const Error& e) {
      return e.what();
    }
    return "no error";
  };
  EXPECT_THAT(error("{\"format\":\"x\"}"), HasSubstr("not an sslcd map"));
  EXPECT_THAT(error("{\"format\":\"sslcd-map\",\"version\":2}"), HasSubstr("version 2"));
  EXPECT_THAT(error("{\"format\":\"sslcd-map\",\"version\":1,\"up_axis\":[0,1]}"),
              HasSubstr("map.json:1: expected a list of 3 numbers"));
  EXPECT_THAT(error("{\"format\":\"sslcd-map\",\"version\":1,\n\"up_axis\":[0,-1,0],\"objects\":["
                    "\n{\"id\":1}]}"),
              HasSubstr("map.json:3: key 'label' is missing"));
  EXPECT_THAT(error("{\"format\": ["), HasSubstr("not JSON"));
  EXPECT_THROW(ReadMapJson(In("none.json")), Error);
}

TEST_F(RunFolder, MapHasALineForEachObject) {
  MapFile map = SmallMap();
  map.objects[0].T_world_object = Pose::Trans(1e20, -0.5, 1e-7);
  map.objects[1].T_world_object = Pose();
  map.objects[1].observations.clear();
  EXPECT_EQ(
      MapJson(map),
      "{\"format\":\"sslcd-map\",\"version\":1,\"up_axis\":[0,-1,0],\"objects\":[\n"
      "{\"id\":7,\"label\":\"Car \\\"x\\\"\",\"state\":\"confirmed\",\"pose_world_object\":"
      "[0,0,0,1,1e+20,-0.5,1e-07],\"dimensions_lwh\":[4.1,1.6,0.30000000000000004],"
      "\"observations\":[[3,14],[4,20]]},\n"
      "{\"id\":9,\"label\":\"Car \\\"x\\\"\",\"state\":\"dynamic\",\"pose_world_object\":"
      "[0,0,0,1,0,0,0],\"dimensions_lwh\":[4.1,1.6,0.30000000000000004],\"observations\":[]}\n"
      "]}\n");
  EXPECT_EQ(MapJson({Vec3(0, 0, 1), {}}),
            "{\"format\":\"sslcd-map\",\"version\":1,\"up_axis\":[0,0,1],\"objects\":[\n]}\n");
}

TEST_F(RunFolder, LabelsOfAnyBytesReadBack) {
  MapFile map = SmallMap();
  map.objects[0].label = "tab\t line\n bell\a back\\slash";
  map.objects[1].label =
      "Stra\xC3\x9F"
      "e \xF0\x9F\x9A\x97";
  WriteFileAtomically(In("map.json"), MapJson(map));
  EXPECT_THAT(ReadFileBytes(In("map.json")), HasSubstr("\"tab\\t line\\n bell\\u0007 back"));
  const MapFile read = ReadMapJson(In("map.json"));
  EXPECT_EQ(read.objects[0].label, map.objects[0].label);
  EXPECT_EQ(read.objects[1].label, map.objects[1].label);
  map.objects[0].label = "latin \xE9";
  WriteFileAtomically(In("map.json"), MapJson(map));
  EXPECT_EQ(ReadMapJson(In("map.json")).objects[0].label, "latin \xEF\xBF\xBD");
}

TEST_F(RunFolder, NumbersThatAreNotFiniteAreNoNumbersInJson) {
  MapFile map = SmallMap();
  map.objects[0].dims.x() = std::numeric_limits<double>::infinity();
  WriteFileAtomically(In("map.json"), MapJson(map));
  EXPECT_THAT(ReadFileBytes(In("map.json")), HasSubstr("\"dimensions_lwh\":[null,1.6,"));
  EXPECT_THROW(ReadMapJson(In("map.json")), Error);
}

TEST_F(RunFolder, StagesAndReasonsOfAnyTextKeepTheFilesWhole) {
  TimingTable timing;
  timing.Add("a \"stage\"\n", 1.5);
  timing.Add("other", 2);
  EXPECT_EQ(TimingJson(timing),
            "{\n\"a \\\"stage\\\"\\n\":{\"count\":1,\"mean_ms\":1.5,\"p50_ms\":1.5,\"p95_ms\":1.5,"
            "\"max_ms\":1.5},\n\"other\":{\"count\":1,\"mean_ms\":2,\"p50_ms\":2,\"p95_ms\":2,"
            "\"max_ms\":2}\n}\n");
  EXPECT_EQ(TimingJson({}), "{\n}\n");

  LoopClosure loop;
  loop.reason = "near, but not \"here\"";
  EXPECT_THAT(LoopsCsv({loop}), HasSubstr("\n0,0,none,\"near, but not \"\"here\"\"\",0.000,"));
}

TEST_F(RunFolder, WritesEveryFileAndNoTemporaryOnes) {
  RunOutputs outputs;
  outputs.trajectory = outputs.odometry = Path();
  outputs.map = SmallMap();
  outputs.graph.vertices = {{0, Pose(), true}, {1, Path().poses[1], false}};
  outputs.graph.edges = {{0, 1, Path().poses[1], {}}};
  outputs.graph.edges[0].information.setIdentity();
  outputs.timing.Add("data association", 1.5);
  outputs.metrics = {{"ate_m", 1.25}, {"iou", std::nullopt}, {"nan", std::nan("")}};
  const auto paths = WriteRunFolder(In("deep/run"), outputs);
  EXPECT_EQ(paths.size(), 11u);
  for (const std::string& path : paths) EXPECT_TRUE(fs::is_regular_file(path)) << path;
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator(In("deep/run"))) ++files;
  EXPECT_EQ(files, paths.size());
  EXPECT_EQ(ReadFileBytes(In("deep/run/metrics.json")),
            "{\n\"ate_m\":1.25,\n\"iou\":null,\n\"nan\":null\n}\n");
  EXPECT_THAT(ReadFileBytes(In("deep/run/graph.g2o")), HasSubstr("VERTEX_SE3:QUAT 0 0.000000000"));
  EXPECT_THAT(ReadFileBytes(In("deep/run/graph.g2o")), HasSubstr("FIX 0\n"));
  EXPECT_THAT(ReadFileBytes(In("deep/run/map.ply")), HasSubstr("element vertex 13\n"));
  EXPECT_THAT(ReadFileBytes(In("deep/run/map.ply")), HasSubstr("element face 6\n"));
}

TEST_F(RunFolder, AFullDiskLeavesTheOldFileAlone) {
  EXPECT_THROW(WriteFileAtomically("/dev/full", "text"), Error);
  EXPECT_TRUE(fs::is_character_file("/dev/full")) << "a device must not be renamed away";
  WriteFileAtomically(In("file"), "old");
  fs::create_directory(In("file2"));
  EXPECT_THROW(WriteFileAtomically(In("file2"), "new"), Error);
  EXPECT_THROW(WriteFileAtomically(In("file/below"), "new"), Error);
  EXPECT_EQ(ReadFileBytes(In("file")), "old");
}

TEST_F(RunFolder, OfSeveralFilesAllAreWrittenOrNone) {
  fs::create_directory(In("folder"));
  WriteFileAtomically(In("a"), "old");
  EXPECT_THROW(WriteFilesAtomically({{In("a"), "new"}, {In("folder"), "new"}}), Error);
  EXPECT_THROW(WriteFilesAtomically({{In("a"), "new"}, {In("none/b"), "new"}}), Error);
  EXPECT_EQ(ReadFileBytes(In("a")), "old");
  WriteFilesAtomically({{In("a"), "new"}, {In("b"), "too"}});
  EXPECT_EQ(ReadFileBytes(In("a")), "new");
  EXPECT_EQ(ReadFileBytes(In("b")), "too");
  for (const auto& entry : fs::directory_iterator(In("")))
    EXPECT_THAT(entry.path().filename().string(), testing::Not(HasSubstr("tmp")))
        << "nothing is left behind";
}

TEST_F(RunFolder, FoldersThatCannotBe) {
  WriteFileAtomically(In("file"), "x");
  try {
    MakeWritableFolder(In("file/run"));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kOutput);
    EXPECT_THAT(error.what(), HasSubstr("file/run: cannot be written"));
  }
  EXPECT_THROW(MakeWritableFolder("/proc/sslcd"), Error);
}

}  // namespace
}  // namespace sslcd
