// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/frontend/image_frontend.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "sslcd/core/error.h"
#include "sslcd/core/log.h"

namespace sslcd {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

constexpr int kWidth = 320, kHeight = 200;
// [px], [m], [m] in front of the first camera
constexpr double kFocal = 200, kBaseline = 0.5, kWall = 12;

// A wall with a random pattern that the camera comes nearer to by 0.2 m a frame; without its right
// image its speed is unknown.
Image Wall(int frame, bool right) {
  static const std::vector<unsigned char> pattern = [] {
    std::vector<unsigned char> dots(400 * 400);
    std::mt19937 random(1);
    for (unsigned char& dot : dots) dot = static_cast<unsigned char>(40 + random() % 180);
    return dots;
  }();
  const double depth = kWall - 0.2 * frame;
  Image image{std::vector<unsigned char>(3 * kWidth * kHeight), kWidth, kHeight, 3};
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      const double x = (u - kWidth / 2) * depth / kFocal + (right ? kBaseline : 0),
                   y = (v - kHeight / 2) * depth / kFocal;
      // Bilinear, 10 dots a metre.
      const double c = 200 + 10 * x, r = 200 + 10 * y;
      const int c0 = static_cast<int>(std::floor(c)), r0 = static_cast<int>(std::floor(r));
      const auto dot = [](int column, int row) {
        return pattern[static_cast<std::size_t>(std::clamp(row, 0, 399) * 400 +
                                                std::clamp(column, 0, 399))];
      };
      const double a = c - c0, b = r - r0;
      const double value = (1 - b) * ((1 - a) * dot(c0, r0) + a * dot(c0 + 1, r0)) +
                           b * ((1 - a) * dot(c0, r0 + 1) + a * dot(c0 + 1, r0 + 1));
      for (int k = 0; k < 3; ++k)
        image.pixels[static_cast<std::size_t>(3 * (v * kWidth + u) + k)] =
            static_cast<unsigned char>(value);
    }
  }
  return image;
}

// "left/7": the left image of frame 7; "broken/7" cannot be read, "small/7" has another size.
Image Load(const std::string& path) {
  const std::string kind = path.substr(0, path.find('/'));
  if (kind == "broken") return {};
  Image image = Wall(std::stoi(path.substr(path.find('/') + 1)), kind == "right");
  if (kind == "small") {
    image.height /= 2;
    image.pixels.resize(image.pixels.size() / 2);
  }
  return image;
}

ImageSequence Approach(int frames) {
  ImageSequence sequence;
  sequence.camera = {{kFocal, kFocal, kWidth / 2, kHeight / 2, {0, 0, 0}, kWidth, kHeight},
                     kBaseline};
  for (int i = 0; i < frames; ++i) {
    Frame& frame = sequence.frames.emplace_back();
    frame.index = i;
    frame.image_left = "left/" + std::to_string(i);
    frame.image_right = "right/" + std::to_string(i);
  }
  sequence.odometry = true;
  sequence.boxes.emplace();
  for (int i = 0; i < frames; ++i) (*sequence.boxes)[i] = {{"Car", 0.9, {100, 60, 180, 150}}};
  return sequence;
}

std::vector<Frame> All(ImageFrontend& frontend) {
  std::vector<Frame> frames;
  while (std::optional<Frame> frame = frontend.Next()) frames.push_back(*frame);
  return frames;
}

class ImageFrontendTest : public testing::Test {
 protected:
  ImageFrontendTest()
      : before_(SetLogSink(
            [this](LogLevel, const std::string& message) { messages_.push_back(message); })) {}
  ~ImageFrontendTest() override { SetLogSink(before_); }

  std::vector<std::string> messages_;
  LogSink before_;
};

TEST_F(ImageFrontendTest, FindsItsWayAndLooksIntoBoxes) {
  std::vector<int> watched;
  ImageFrontend frontend(
      Approach(12), {}, {},
      {Load, [&](const Frame& frame, const ImageView&) { watched.push_back(frame.index); }}, 4);
  const std::vector<Frame> frames = All(frontend);
  ASSERT_EQ(frames.size(), 12u);
  for (int i = 0; i < 12; ++i) {
    EXPECT_EQ(frames[i].index, i);
    EXPECT_NEAR(frames[i].T_odom_cam.translation().z(), 0.2 * i, 0.02 + 0.01 * i);
  }
  const FrontendReport report = frontend.Finish();
  EXPECT_EQ(report.frames, 12);
  EXPECT_EQ(report.images_failed, 0);
  EXPECT_EQ(report.lost, 0);
  int boxes = 0;
  for (const auto& [status, count] : report.lift) boxes += count;
  EXPECT_EQ(boxes, 12) << "each is accounted for, lifted or not";
  EXPECT_EQ(report.ground.frames, 2) << "the first and the eleventh";
  EXPECT_EQ(report.ground.elsewhere, 2) << "there is only a wall";
  EXPECT_EQ(watched.size(), 12u);
  EXPECT_TRUE(std::is_sorted(watched.begin(), watched.end()));
  EXPECT_EQ(report.timing.Summary().count("stereo odometry"), 1u);
}

TEST_F(ImageFrontendTest, IsTheSameForAnyNumberOfThreads) {
  ImageFrontend one(Approach(8), {}, {}, {Load}, 1), many(Approach(8), {}, {}, {Load}, 8);
  const std::vector<Frame> a = All(one), b = All(many);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_TRUE(a[i].T_odom_cam.matrix() == b[i].T_odom_cam.matrix());
    ASSERT_EQ(a[i].detections.size(), b[i].detections.size());
    for (std::size_t k = 0; k < a[i].detections.size(); ++k) {
      EXPECT_EQ(a[i].detections[k].row, b[i].detections[k].row);
      EXPECT_EQ(a[i].detections[k].appearance[Cue::kColour],
                b[i].detections[k].appearance[Cue::kColour]);
      EXPECT_TRUE(a[i].detections[k].T_cam_object.matrix() ==
                  b[i].detections[k].T_cam_object.matrix());
    }
  }
}

TEST_F(ImageFrontendTest, AFrameWithoutImagesIsBridgedAndNamed) {
  ImageSequence sequence = Approach(10);
  sequence.frames[5].image_left = "broken/5";
  sequence.frames[7].image_right = "";
  ImageFrontend frontend(std::move(sequence), {}, {}, {Load}, 3);
  const std::vector<Frame> frames = All(frontend);
  ASSERT_EQ(frames.size(), 10u);
  EXPECT_TRUE(frames[5].detections.empty());
  EXPECT_NEAR(frames[9].T_odom_cam.translation().z(), 1.8, 0.15);
  EXPECT_EQ(frontend.Finish().images_failed, 2);
  EXPECT_THAT(messages_, Contains(HasSubstr("broken/5: no image that can be read")));
  EXPECT_THAT(messages_, Contains(HasSubstr("frame 7 has no right image")));
}

TEST_F(ImageFrontendTest, AnOdometryThatHasFollowedNothingIsNone) {
  for (const bool swapped : {true, false}) {
    ImageSequence sequence = Approach(5);
    for (Frame& frame : sequence.frames)
      swapped ? std::swap(frame.image_left, frame.image_right)
              : void(frame.image_right = "broken/0");
    ImageFrontend frontend(std::move(sequence), {}, {}, {Load}, 2);
    for (int i = 0; i < 5; ++i) EXPECT_TRUE(frontend.Next());
    try {
      frontend.Next();
      ADD_FAILURE() << "no error";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kNoSolution);
      EXPECT_THAT(error.what(), HasSubstr("not one of 5 frames"));
      EXPECT_THAT(error.what(), HasSubstr(swapped ? "swapped" : "missing"));
    }
    EXPECT_FALSE(frontend.Next()) << "said once";
  }
}

TEST_F(ImageFrontendTest, APairOfDifferentSizesIsAnErrorWithItsName) {
  ImageSequence sequence = Approach(6);
  sequence.frames[3].image_right = "small/3";
  for (const int threads : {1, 4}) {
    ImageFrontend frontend(sequence, {}, {}, {Load}, threads);
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(frontend.Next());
    try {
      frontend.Next();
      ADD_FAILURE() << "no error";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kBadInput);
      EXPECT_THAT(error.what(), HasSubstr("left/3"));
      EXPECT_THAT(error.what(), HasSubstr("320x100"));
    }
  }
}

TEST_F(ImageFrontendTest, CanBeLeftInTheMiddle) {
  ImageFrontend frontend(Approach(30), {}, {}, {Load}, 4);
  EXPECT_TRUE(frontend.Next());
  frontend.Finish();
  EXPECT_FALSE(frontend.Next());
}

TEST_F(ImageFrontendTest, SaysWhatIsMissing) {
  ImageSequence sequence = Approach(3);
  sequence.boxes.reset();
  EXPECT_THROW(ImageFrontend(sequence, {}, {}, {Load}, 1), Error) << "neither boxes nor a detector";
  sequence = Approach(3);
  for (Frame& frame : sequence.frames) frame.image_right.clear();
  EXPECT_THROW(ImageFrontend(sequence, {}, {}, {Load}, 1), Error) << "no pair of images";
}

TEST_F(ImageFrontendTest, LiftedLabelsAreTheSameFromBehind) {
  ImageFrontend frontend(Approach(1), {}, {}, {Load}, 1);
  LabelTable labels;
  labels.Set("Van", {Symmetry::kNone});
  labels.Set("Pedestrian", {Symmetry::kFull});
  frontend.AddLabels(labels);
  EXPECT_EQ(labels["Car"].symmetry, Symmetry::kPi);
  EXPECT_EQ(labels["Van"].symmetry, Symmetry::kPi) << "told so of other detections";
  EXPECT_EQ(labels["Pedestrian"].symmetry, Symmetry::kFull);
}

}  // namespace
}  // namespace sslcd
