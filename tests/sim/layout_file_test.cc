// SPDX-License-Identifier: BSD-3-Clause
#include "sim/layout_file.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/halv.h"
#include "temp_folder.h"

namespace sslcd::sim {
namespace {

std::string Car(double x, double y, double yaw, const std::string& more = "") {
  char text[256];
  std::snprintf(text, sizeof text,
                R"({"x": %g, "y": %g, "z": 0.4, "qx": 0, "qy": 0, "qz": %.9f, "w": %.9f%s})", x, y,
                std::sin(0.5 * yaw), std::cos(0.5 * yaw), more.c_str());
  return text;
}

TEST(ReadLayout, KnowsTheLengthAxisAndLeavesOutDoubles) {
  const TempFolder folder;
  // Side by side along x, 2.6 m apart, yaw 0: their length must be along y, which is ahead.
  const std::string path = folder.Write(
      "a.json", "[" + Car(0, 0, 0) + ",\n" + Car(2.6, 0, 0) + ",\n" +
                    Car(5.2, 0, 0, R"(, "label": "Van")") + ",\n" + Car(5.2, 0.1, 0) + "]");
  const LayoutFile file = ReadLayout(path);
  ASSERT_EQ(file.slots.size(), 3u);
  EXPECT_EQ(file.doubles, 1);
  EXPECT_EQ(file.slots[1].x, 2.6);
  EXPECT_NEAR(std::sin(file.slots[0].heading), 0, 1e-6);  // ahead or back
  EXPECT_EQ(file.slots[0].label, "");
  EXPECT_EQ(file.slots[2].label, "Van");
}

TEST(ReadLayout, BadFilesAreNamed) {
  const TempFolder folder;
  const auto refuse = [&](const std::string& text, const std::vector<std::string>& parts) {
    const std::string path = folder.Write("bad.json", text);
    std::vector<std::string> all = parts;
    all.push_back("bad.json");
    ExpectError([&] { ReadLayout(path); }, all);
  };
  refuse("", {"bad.json:1", "not JSON"});
  refuse("[]", {"list of cars"});
  refuse("{\"x\": 1}", {"list of cars"});
  refuse("[{\"x\": 1,", {"bad.json:1:"});
  refuse("[3]", {"bad.json:1", "keys x, y"});
  refuse("[" + Car(0, 0, 0) + ",\n{\"x\": 1}]", {"bad.json:2", "'y' is missing"});
  refuse(R"([{"x": "one", "y": 0}])", {"'x' must be a number"});
  refuse(R"([{"x": NaN, "y": 0}])", {"bad.json:1:8: not JSON"});
  refuse(R"([{"x": 1, "y": 0, "z": 0, "qx": 0, "qy": 0, "qz": 0, "w": 2}])", {"unit quaternion"});
  refuse(R"([{"x": 1, "y": 0, "z": 0, "qx": 0, "qy": 0, "qz": 0}])", {"'w' is missing"});
  refuse("[" + Car(0, 0, 0, R"(, "label": "Boat")") + "]", {"'label' must be"});
  refuse("[" + Car(0, 0, 0, R"(, "lable": "Van")") + "]", {"unknown key 'lable'"});
  refuse("[" + Car(0, 0, 0, R"(, "x": 3)") + "]", {"key 'x' is a duplicate"});
  refuse("[" + Car(1e300, 0, 0) + "]", {"more than 10 km"});
  ExpectError([] { ReadLayout("/nowhere.json"); }, {"/nowhere.json"});
}

TEST(PlaceLayout, PathOutsideTheLot) {
  const TempFolder folder;
  std::string cars = "[";
  for (int i = 0; i < 12; ++i) cars += (i ? ",\n" : "") + Car(2.6 * i, 0, 0);
  HalvScene scene;
  scene.layout = folder.Write("small.json", cars + "]");
  ExpectError([&] { MakeHalvWorld(1, scene); }, {"leaves the lot", "--size"});
  scene.case_number = 4;
  scene.size = 0.3;
  EXPECT_GE(MakeHalvWorld(1, scene).world.objects.size(), 8u);
}

TEST(PlaceLayout, TheRealLot) {
  SSLCD_REAL_DATA(folder, "perch-parking-cuboids");
  const LayoutFile file = ReadLayout(folder + "/very-important-3-cuboids.json");
  EXPECT_EQ(file.slots.size(), 78u);
  EXPECT_EQ(file.doubles, 1);  // one car is in the file twice
  for (int number = 1; number <= 4; ++number) {
    HalvScene scene;
    scene.case_number = number;
    scene.driving_cars = 0;
    scene.layout = folder + "/very-important-3-cuboids.json";
    const HalvWorld halv = MakeHalvWorld(1, scene);
    EXPECT_EQ(static_cast<int>(halv.world.objects.size()) + halv.left_out, 79);
    EXPECT_LT(halv.left_out, 20);
  }
}

}  // namespace
}  // namespace sslcd::sim
