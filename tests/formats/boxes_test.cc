// SPDX-License-Identifier: BSD-3-Clause
#include "formats/boxes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sslcd/core/error.h"
#include "temp_folder.h"

namespace sslcd {
namespace {

std::map<int, std::vector<ImageDetection>> Read(const std::string& text) {
  const TempFolder folder;
  return ReadBoxes(folder.Write("boxes_reader_test.txt", text));
}

TEST(ReadBoxes, KeepsTheOrderWithinAFrame) {
  const auto frames = Read(
      "# frame label score left top right bottom\n3 Car 0.9 1 2 3.5 4\n0 Van 1 5 6 7 8\n3 Truck 0 "
      "0 0 9 9\n");
  ASSERT_EQ(frames.size(), 2u);
  ASSERT_EQ(frames.at(3).size(), 2u);
  EXPECT_EQ(frames.at(3)[0].label, "Car");
  EXPECT_EQ(frames.at(3)[0].score, 0.9);
  EXPECT_EQ(frames.at(3)[0].box.right, 3.5);
  EXPECT_EQ(frames.at(3)[1].label, "Truck");
  EXPECT_EQ(frames.at(0)[0].box.bottom, 8);
  EXPECT_TRUE(Read("").empty());
}

TEST(ReadBoxes, RefusesWhatIsNoBox) {
  for (const char* row :
       {"0 Car 1 1 2 3", "0 Car 1 1 2 3 4 5", "0 Car 1 1 2 x 4", "-1 Car 1 1 2 3 4",
        "0 Car 1.5 1 2 3 4", "0 Car nan 1 2 3 4", "0 Car 1 3 2 1 4", "0 Car 1 1 2 1 4",
        "0 Car 1 nan 2 3 4", "0 Car 1 1 2 inf 4", "0.5 Car 1 1 2 3 4"}) {
    try {
      Read(std::string("0 Car 1 1 2 3 4\n") + row + "\n");
      ADD_FAILURE() << row;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kBadInput);
      EXPECT_THAT(error.what(), testing::HasSubstr("boxes_reader_test.txt:2")) << row;
    }
  }
  EXPECT_THROW(ReadBoxes("/nowhere/boxes.txt"), Error);
}

}  // namespace
}  // namespace sslcd
