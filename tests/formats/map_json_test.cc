// SPDX-License-Identifier: BSD-3-Clause
#include "formats/map_json.h"

#include <limits>

#include "formats/text_rows.h"
#include "temp_folder.h"

namespace sslcd {
namespace {

MapFile SmallMap() {
  MapFile map;
  MapObject object;
  object.id = {7};
  object.label = "Car \"x\"";
  object.state = LandmarkState::kConfirmed;
  object.T_world_object = Pose::Exp((Vec6() << 2, -1, 1e-12, 0.6, 0.1, -1.4).finished());
  object.dims = Vec3(4.1, 1.6, 0.1 + 0.2);
  object.observations = {{3, 14}, {4, 20}};
  map.objects = {object, object};
  map.objects[1].id = {9};
  map.objects[1].state = LandmarkState::kDynamic;
  return map;
}

TEST(MapJson, ReadsBackToTheBit) {
  const TempFolder folder;
  const MapFile map = SmallMap();
  folder.Write("map.json", MapJson(map));
  const MapFile read = ReadMapJson(folder.In("map.json"));
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

TEST(MapJson, HasALineForEachObject) {
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

TEST(MapJson, LabelsOfAnyBytesReadBack) {
  const TempFolder folder;
  MapFile map = SmallMap();
  map.objects[0].label = "tab\t line\n bell\a back\\slash";
  map.objects[1].label =
      "Stra\xC3\x9F"
      "e \xF0\x9F\x9A\x97";
  folder.Write("map.json", MapJson(map));
  EXPECT_THAT(ReadFileBytes(folder.In("map.json")),
              testing::HasSubstr("\"tab\\t line\\n bell\\u0007 back"));
  const MapFile read = ReadMapJson(folder.In("map.json"));
  EXPECT_EQ(read.objects[0].label, map.objects[0].label);
  EXPECT_EQ(read.objects[1].label, map.objects[1].label);
  map.objects[0].label = "latin \xE9";
  folder.Write("map.json", MapJson(map));
  EXPECT_EQ(ReadMapJson(folder.In("map.json")).objects[0].label, "latin \xEF\xBF\xBD");
}

TEST(MapJson, NumbersThatAreNotFiniteBecomeNull) {
  const TempFolder folder;
  MapFile map = SmallMap();
  map.objects[0].dims.x() = std::numeric_limits<double>::infinity();
  folder.Write("map.json", MapJson(map));
  EXPECT_THAT(ReadFileBytes(folder.In("map.json")),
              testing::HasSubstr("\"dimensions_lwh\":[null,1.6,"));
  EXPECT_THROW(ReadMapJson(folder.In("map.json")), Error);
}

TEST(MapJson, BadMapsAreRefusedWithTheirLine) {
  const TempFolder folder;
  const auto refuse = [&](const std::string& text, const std::string& part) {
    ExpectError([&] { ReadMapJson(folder.Write("map.json", text)); }, {part});
  };
  const std::string head = "{\"format\":\"sslcd-map\",\"version\":1,\"up_axis\":";
  refuse("{\"format\":\"x\"}", "map.json:1: this is not an sslcd map");
  refuse("{\"format\":\"sslcd-map\",\"version\":2}", "map.json:1: version 2 of");
  refuse(head + "[0,1]}", "map.json:1: expected a list of 3 numbers");
  refuse(head + "[0,-1,0],\n\"objects\":[\n{\"id\":1}]}", "map.json:3: key 'label' is missing");
  refuse(head + "[0,-1,0],\n\"objects\":[{\"id\":1,\"label\":\"a\",\"state\":\"b\"}]}",
         "map.json:2: unknown state 'b'");
  refuse(head + "[0,-2,0],\n\"objects\":[]}", "map.json:1: up_axis: expected a unit vector");
  MapFile map = SmallMap();
  map.objects[1].id = map.objects[0].id;
  refuse(MapJson(map), "map.json:3: id 7 twice");
  map = SmallMap();
  map.objects[1].dims.y() = 0;
  refuse(MapJson(map), "map.json:3: dimensions_lwh: expected lengths above 0");
  map = SmallMap();
  std::fill_n(map.objects[1].T_world_object.data(), 4, 0.);
  refuse(MapJson(map), "map.json:3: pose_world_object: expected a quaternion of length 1");
  refuse("{\"format\": [", "map.json:1:13: not JSON");
  EXPECT_THROW(ReadMapJson(folder.In("none.json")), Error);
}

}  // namespace
}  // namespace sslcd
