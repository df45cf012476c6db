// SPDX-License-Identifier: BSD-3-Clause
// What the golden models do not show: nothing, ties, broken numbers.
#include "detectors/decode_2d.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace sslcd {
namespace {

using testing::ElementsAre;

ModelOutput Output(ModelLayout layout, int classes = 2) {
  ModelOutput output;
  output.layout = layout;
  output.class_count = classes;
  output.labels = {{0, "Car"}, {1, "Car"}, {2, "Bus"}};
  output.min_score = 0.5;
  output.nms_iou = 0.5;
  return output;
}

TEST(DecodeBoxes, NothingFromNothing) {
  EXPECT_TRUE(DecodeBoxes({{{1, 0, 7}, {}}}, Output(ModelLayout::kYoloV5), 64, 64).empty());
  EXPECT_TRUE(DecodeBoxes({{{1, 6, 0}, {}}}, Output(ModelLayout::kYoloV8), 64, 64).empty());
  EXPECT_TRUE(DecodeBoxes({{{1, 0, 6}, {}}}, Output(ModelLayout::kYoloV10), 64, 64).empty());
  EXPECT_TRUE(DecodeBoxes({{{1, 0, 4}, {}}, {{1, 0}, {}}, {{1, 0}, {}}},
                          Output(ModelLayout::kBoxesScoresLabels), 64, 64)
                  .empty());
}

TEST(DecodeBoxes, AScoreAtTheThresholdIsEnough) {
  const std::vector<Tensor> rows = {{{1, 2, 6}, {1, 2, 3, 4, 0.5f, 0, 1, 2, 3, 4, 0.4999f, 0}}};
  EXPECT_EQ(DecodeBoxes(rows, Output(ModelLayout::kYoloV10), 64, 64).size(), 1u);
}

TEST(DecodeBoxes, FastestDetWithoutObjectness) {  // a negative base of a power
  Tensor map{{1, 7, 1, 1}, {-0.1f, 0, 0, 0, 0, 0.9f, 0.1f}};
  EXPECT_TRUE(DecodeBoxes({map}, Output(ModelLayout::kFastestDet), 8, 8).empty());
  map.values[0] = 1;
  const std::vector<ClassBox> found = DecodeBoxes({map}, Output(ModelLayout::kFastestDet), 8, 8);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].score, std::pow(0.9, 0.4), 1e-6);
  EXPECT_NEAR(found[0].box.right, 2, 1e-6) << "half of the input, around its corner";
}

TEST(SuppressOverlaps, TheBestOfALabelStays) {
  const Box2d a{0, 0, 10, 10}, b{1, 0, 11, 10}, c{20, 0, 30, 10};
  const ModelOutput output = Output(ModelLayout::kYoloV8, 3);
  EXPECT_THAT(SuppressOverlaps({{0, .6, a}, {1, .9, b}, {2, .5, a}, {0, .7, c}}, output),
              ElementsAre(1, 3, 2))
      << "classes 0 and 1 have one label";
  EXPECT_THAT(SuppressOverlaps({{0, .8, a}, {0, .8, a}}, output), ElementsAre(0))
      << "the first of equals";
  EXPECT_TRUE(SuppressOverlaps({}, output).empty());
  ModelOutput all = output;
  all.nms_iou = 1;
  EXPECT_THAT(SuppressOverlaps({{0, .8, a}, {0, .9, a}}, all), ElementsAre(1, 0));
}

TEST(BoxInImage, IsClipped) {
  const InputMap map{2, 4, 10, -20};
  const Box2d box = BoxInImage({0, 0, 30, 20}, map, 8, 100);
  EXPECT_EQ(box.left, 0);
  EXPECT_EQ(box.top, 5);
  EXPECT_EQ(box.right, 8);
  EXPECT_EQ(box.bottom, 10);
  EXPECT_EQ(BoxInImage({100, 0, 130, 20}, map, 8, 100).Area(), 0) << "out of the image";
}

}  // namespace
}  // namespace sslcd
