// SPDX-License-Identifier: BSD-3-Clause
#include "detectors/class_names.h"

#include <gtest/gtest.h>

namespace sslcd {
namespace {

using Names = std::map<int, std::string>;

TEST(ReadClassNames, AsUltralyticsStoresThem) {
  EXPECT_EQ(ReadClassNames("{0: 'person', 1: \"bird's nest\", 12: 'traffic light'}"),
            (Names{{0, "person"}, {1, "bird's nest"}, {12, "traffic light"}}));
}

TEST(ReadClassNames, LeavesOutWhatItCannotRead) {
  for (const char* text : {"", "car", "{0: 'car", "{:'car'}", "{99999999999: 'car'}",
                           "{2147483647: 'car'}", "['a', 'b']"})
    EXPECT_EQ(ReadClassNames(text), Names()) << text;
  EXPECT_EQ(ReadClassNames("{: 'car', 3: 'bus'}"), (Names{{3, "bus"}}));
}

TEST(ChooseLabels, TheVehiclesThatAreNamed) {
  EXPECT_EQ(ChooseLabels({{0, "Car"}, {1, "person"}, {3, "BUS"}, {9, "truck"}}, 4).labels,
            (Names{{0, "Car"}, {3, "Bus"}}))
      << "class 9 is beyond the model's classes";
}

TEST(ChooseLabels, WithoutVehiclesAllAsOneWord) {
  EXPECT_EQ(ChooseLabels({{0, "traffic light"}, {1, ""}}, 2).labels,
            (Names{{0, "traffic_light"}, {1, "_"}}));
}

TEST(ChooseLabels, WithoutNames) {
  EXPECT_EQ(ChooseLabels({}, 80).labels, (Names{{2, "Car"}, {5, "Bus"}, {7, "Truck"}}));
  const ClassLabels one = ChooseLabels({}, 3);
  EXPECT_EQ(one.labels, (Names{{0, "Car"}}));
  EXPECT_NE(one.assumption.find("3 classes"), std::string::npos) << one.assumption;
}

}  // namespace
}  // namespace sslcd
