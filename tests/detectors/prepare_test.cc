// SPDX-License-Identifier: BSD-3-Clause
#include "detectors/prepare.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "../support/temp_folder.h"
#include "sslcd/perception/opencv_image.h"

namespace sslcd {
namespace {

std::vector<float> Planes(const cv::Mat& image, const ModelInput& input, int width, int height,
                          InputMap* map = nullptr) {
  std::vector<float> planes(3 * width * height, -1);
  const InputMap result = Prepare(ViewOf(image), input, width, height, "image", planes.data());
  if (map) *map = result;
  return planes;
}

void ExpectMap(const InputMap& map, double scale_x, double scale_y, double offset_x,
               double offset_y) {
  EXPECT_DOUBLE_EQ(map.scale_x, scale_x);
  EXPECT_DOUBLE_EQ(map.scale_y, scale_y);
  EXPECT_DOUBLE_EQ(map.offset_x, offset_x);
  EXPECT_DOUBLE_EQ(map.offset_y, offset_y);
}

TEST(Prepare, PlanesInTheModelsOrderNormalised) {
  cv::Mat image(2, 3, CV_8UC3, cv::Scalar(10, 20, 30));  // B G R
  image.at<cv::Vec3b>(1, 2) = {40, 50, 60};
  ModelInput input;
  input.scale = 0.1;
  input.mean = {1, 2, 0};
  input.std = {1, 2, 4};
  const std::vector<float> rgb = Planes(image, input, 3, 2);
  EXPECT_FLOAT_EQ(rgb[0], 2);     // (3 - 1) / 1
  EXPECT_FLOAT_EQ(rgb[5], 5);     // (6 - 1) / 1, the last pixel of the first plane
  EXPECT_FLOAT_EQ(rgb[6], 0);     // (2 - 2) / 2
  EXPECT_FLOAT_EQ(rgb[12], .25);  // 1 / 4
  input.channels = ModelInput::Channels::kBgr;
  EXPECT_FLOAT_EQ(Planes(image, input, 3, 2)[0], 0);
}

TEST(Prepare, RowsOfALargerImageAreFoundByItsStride) {
  cv::Mat large(4, 8, CV_8UC3, cv::Scalar::all(0));
  large.at<cv::Vec3b>(2, 5) = {255, 255, 255};
  const cv::Mat part = large(cv::Rect(4, 1, 3, 3));
  const std::vector<float> planes = Planes(part, {}, 3, 3);
  EXPECT_EQ(std::count(planes.begin(), planes.end(), 1.f), 3);
  EXPECT_EQ(planes[1 * 3 + 1], 1.f);
}

TEST(Prepare, MapsLeadThereAndBack) {
  const cv::Mat image(100, 400, CV_8UC3, cv::Scalar::all(7));
  InputMap map;
  ModelInput input;
  Planes(image, input, 200, 200, &map);
  ExpectMap(map, .5, 2, 0, 0);
  input.crop_top_px = 50;
  Planes(image, input, 200, 200, &map);
  ExpectMap(map, .5, 4, 0, -200);
  EXPECT_DOUBLE_EQ(map.ToImage(10, 20).y(), 55);
  EXPECT_DOUBLE_EQ(map.ToInput(20, 55).y(), 20);
  EXPECT_DOUBLE_EQ(map.ToInput(20, 55).x(), 10);
}

TEST(Prepare, LetterboxIsGreyAroundTheMiddle) {
  const cv::Mat image(100, 400, CV_8UC3, cv::Scalar::all(255));
  ModelInput input;
  input.resize = ModelInput::Resize::kLetterbox;
  InputMap map;
  const std::vector<float> planes = Planes(image, input, 200, 200, &map);
  ExpectMap(map, .5, .5, 0, 75);
  EXPECT_FLOAT_EQ(planes[74 * 200], 114 / 255.f);
  EXPECT_FLOAT_EQ(planes[75 * 200], 1);
  EXPECT_FLOAT_EQ(planes[124 * 200], 1);
  EXPECT_FLOAT_EQ(planes[125 * 200], 114 / 255.f);
}

TEST(Prepare, LetterboxCornerIsGreyBelowAndOnTheRight) {
  const cv::Mat image(100, 400, CV_8UC3, cv::Scalar::all(255));
  ModelInput input;
  input.resize = ModelInput::Resize::kLetterboxCorner;
  InputMap map;
  const std::vector<float> planes = Planes(image, input, 200, 200, &map);
  ExpectMap(map, .5, .5, 0, 0);
  EXPECT_FLOAT_EQ(planes[49 * 200 + 199], 1);
  EXPECT_FLOAT_EQ(planes[50 * 200], 114 / 255.f);
  EXPECT_FLOAT_EQ(Planes(image, input, 800, 100, &map)[400], 114 / 255.f);
}

TEST(Prepare, FitHeightCutsOrFillsOnTheRight) {
  const cv::Mat image(100, 400, CV_8UC3, cv::Scalar::all(255));
  ModelInput input;
  input.resize = ModelInput::Resize::kFitHeight;
  InputMap map;
  EXPECT_EQ(Planes(image, input, 100, 50, &map)[99], 1);
  ExpectMap(map, .5, .5, 0, 0);
  const std::vector<float> filled = Planes(image, input, 300, 50, &map);
  EXPECT_EQ(filled[199], 1);
  EXPECT_EQ(filled[200], 0);
  ExpectMap(map, .5, .5, 0, 0);
}

TEST(Prepare, RefusesGreyEmptyAndTooLow) {
  float plane[3];
  const cv::Mat grey(4, 4, CV_8UC1, cv::Scalar(1)), colour(4, 4, CV_8UC3, cv::Scalar::all(1));
  ModelInput input;
  ExpectError([&] { Prepare(ViewOf(grey), input, 1, 1, "left image", plane); },
              {"left image", "grey", "needs colour"});
  ExpectError([&] { Prepare({}, input, 1, 1, "left image", plane); }, {"left image", "empty"});
  input.crop_top_px = 4;
  ExpectError([&] { Prepare(ViewOf(colour), input, 1, 1, "image", plane); },
              {"4 rows", "crop_top_px"});
}

}  // namespace
}  // namespace sslcd
