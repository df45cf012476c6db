// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/grey.h"

#include <gtest/gtest.h>

#include "sslcd/core/error.h"
#include "sslcd/perception/opencv_image.h"

namespace sslcd {
namespace {

TEST(Grey, OfColourIsItsBrightnessAndOfGreyTheSamePixels) {
  const cv::Mat colour(2, 3, CV_8UC3, cv::Scalar(10, 20, 30));
  EXPECT_EQ(Grey(ViewOf(colour)).at<unsigned char>(1, 2), 22);  // .114 blue + .587 green + .299 red
  const cv::Mat grey(2, 3, CV_8UC1, cv::Scalar(7));
  EXPECT_EQ(Grey(ViewOf(grey)).data, grey.data);
  EXPECT_THROW(Grey({}), Error);
}

}  // namespace
}  // namespace sslcd
