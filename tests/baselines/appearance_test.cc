// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/appearance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "formats/atomic_file.h"
#include "sslcd/core/error.h"
#include "temp_folder.h"

namespace sslcd::baselines {
namespace {

namespace fs = std::filesystem;
// 50 pixels of shift for a metre, 10 of disparity
constexpr double kFocal = 300, kBaseline = 0.2, kDepth = 6;
constexpr int kWidth = 320, kHeight = 240;

// A camera goes along a painted wall, looking at it: to the right for 8 m, then it starts again at
// the left.
class Wall : public testing::Test {
 protected:
  Wall() {
    for (const char* images : {"/image_2", "/image_3"}) fs::create_directories(folder_ + images);
    cv::RNG random(1);
    wall_ = cv::Mat(kHeight, 1200, CV_8UC1, cv::Scalar(90));
    for (int i = 0; i < 1500; ++i) {
      const cv::Point corner(random.uniform(0, wall_.cols), random.uniform(0, wall_.rows));
      cv::rectangle(wall_, cv::Rect(corner, cv::Size(random.uniform(3, 25), random.uniform(3, 25))),
                    cv::Scalar(random.uniform(0, 256)), cv::FILLED);
    }
    std::string times, poses, config = "detections: detections.txt\n";
    for (int i = 0; i < 12; ++i) {
      WriteImages(i, i % 8);
      times += std::to_string(0.1 * i) + "\n";
      poses += std::to_string(0.1 * i) + " " + std::to_string(i) + " 0 0 0 0 0 1\n";
    }
    WriteFileAtomically(folder_ + "/times.txt", times);
    WriteFileAtomically(folder_ + "/odometry.txt", poses);
    WriteFileAtomically(folder_ + "/detections.txt", "");
    WriteFileAtomically(folder_ + "/calib.txt", Calib());
    options_.every = 1;
    options_.training_images = 12;
    options_.features = 300;
    options_.least_inliers = 50;
  }

  static std::string Calib() {
    const std::string start = "300 0 160 ", end = " 0 300 120 0 0 0 1 0\n";
    return "P0: " + start + "0" + end + "P1: " + start + "-60" + end + "P2: " + start + "0" + end +
           "P3: " + start + "-60" + end;
  }
  void WriteImages(int frame, double at_m) const {
    char name[16];
    std::snprintf(name, sizeof name, "%06d.png", frame);
    const int left = static_cast<int>(at_m * kFocal / kDepth),
              right = left + static_cast<int>(kBaseline * kFocal / kDepth);
    cv::imwrite(folder_ + "/image_2/" + name, wall_(cv::Rect(left, 0, kWidth, kHeight)));
    cv::imwrite(folder_ + "/image_3/" + name, wall_(cv::Rect(right, 0, kWidth, kHeight)));
  }
  // What the left camera of the frame sees becomes something else.
  void Repaint(int frame, const std::function<cv::Mat(const cv::Mat&)>& change) const {
    char name[32];
    std::snprintf(name, sizeof name, "/image_2/%06d.png", frame);
    cv::imwrite(folder_ + name, change(cv::imread(folder_ + name, cv::IMREAD_GRAYSCALE)));
  }
  std::optional<PlaceAnswer> Ask(int frame, int old_frame) const {
    const std::vector<LayoutObject> none;
    return AppearanceMatcher(folder_, options_)({none, none, frame, old_frame});
  }
  void ExpectRefused(const std::string& message) const {
    try {
      Ask(9, 4);
      FAIL() << message;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
    }
  }
  TempFolder temp_;
  const std::string folder_ = temp_.path();
  cv::Mat wall_;
  AppearanceOptions options_;
};

TEST_F(Wall, KnowsThePlaceAndMeasuresThePose) {
  const auto answer = Ask(9, 4);  // the camera is at 1 m
  ASSERT_TRUE(answer);
  EXPECT_TRUE(answer->accepted);
  EXPECT_GE(answer->score, 50);
  const double expected = 1. - answer->match_frame;  // the old camera's x is its number
  EXPECT_LE(std::abs(expected), 1);
  EXPECT_NEAR(answer->T_match_query.translation().x(), expected, 0.1);
  EXPECT_NEAR(answer->T_match_query.translation().z(), 0, 0.2);
  EXPECT_LT(answer->T_match_query.so3().Log().norm(), 0.03);
}

TEST_F(Wall, KnowsThePlaceInAnotherLight) {
  Repaint(9, [](const cv::Mat& image) { return cv::Mat(image * 0.6 + 30); });
  const auto answer = Ask(9, 4);
  ASSERT_TRUE(answer);
  EXPECT_TRUE(answer->accepted);
  EXPECT_NEAR(answer->T_match_query.translation().x(), 1. - answer->match_frame, 0.1);
}

TEST_F(Wall, MeasuresATurn) {
  const double turn = 15 * M_PI / 180;  // about the camera's down axis: to the right
  const cv::Matx33d K(kFocal, 0, kWidth / 2., 0, kFocal, kHeight / 2., 0, 0, 1);
  const cv::Matx33d turned_from(std::cos(turn), 0, -std::sin(turn), 0, 1, 0, std::sin(turn), 0,
                                std::cos(turn));
  Repaint(9, [&](const cv::Mat& image) {
    cv::Mat seen;
    cv::warpPerspective(image, seen, cv::Mat(K * turned_from * K.inv()), image.size());
    return seen;
  });
  options_.reprojection_px = 1;  // a plane looks much the same from the other side of its normal
  const auto answer = Ask(9, 4);
  ASSERT_TRUE(answer);
  EXPECT_TRUE(answer->accepted);
  const Vec3 axis = answer->T_match_query.so3().Log();
  EXPECT_NEAR(axis.y(), turn, 0.03);
  EXPECT_LT(std::hypot(axis.x(), axis.z()), 0.03);
  options_.max_turn_deg = 10;
  const auto limited = Ask(9, 4);
  EXPECT_FALSE(limited && limited->accepted);
}

TEST_F(Wall, NothingToBeSeen) {
  Repaint(9,
          [](const cv::Mat& image) { return cv::Mat(image.size(), image.type(), cv::Scalar(90)); });
  EXPECT_FALSE(Ask(9, 4));
}

TEST_F(Wall, PointsFarOffDoNotCount) {
  options_.max_depth_m = kDepth - 1;
  EXPECT_FALSE(Ask(9, 4));
}

TEST_F(Wall, OldImagesOnly) {
  EXPECT_FALSE(Ask(9, -1)) << "nothing is old";
  const auto answer = Ask(7, 0);  // at 7 m, frame 0 saw up to 6.4 m from its own place
  EXPECT_TRUE(!answer || !answer->accepted);
}

TEST_F(Wall, LimitsOfTurnAndDistance) {
  options_.max_apart_m = 0;
  EXPECT_FALSE(Ask(9, 4));
}

TEST_F(Wall, BadFolders) {
  Repaint(9, [](const cv::Mat& image) { return image.rowRange(0, kHeight / 2).clone(); });
  ExpectRefused("has not the size");
  fs::remove(folder_ + "/image_3/000009.png");
  ExpectRefused("image_3/000009.png");
  WriteFileAtomically(folder_ + "/image_2/000004.png", "no image");
  ExpectRefused("000004.png");
  fs::remove_all(folder_ + "/image_2");
  ExpectRefused("has no images");
  fs::remove(folder_ + "/calib.txt");
  ExpectRefused("calib.txt");
}

}  // namespace
}  // namespace sslcd::baselines
