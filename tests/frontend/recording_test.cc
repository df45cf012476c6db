// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/frontend/recording.h"

#include <gtest/gtest.h>

#include "sslcd/core/log.h"
#include "temp_folder.h"

namespace sslcd {
namespace {

Dataset Pairs() {
  Dataset dataset;
  dataset.name = "drive";
  dataset.camera = Camera{200, 200, 160, 60, Vec3::Zero(), 0, 0};
  dataset.camera_right = dataset.camera;
  dataset.camera_right->offset.x() = -0.5;
  dataset.frames.resize(3);
  for (Frame& frame : dataset.frames) frame.image_left = frame.image_right = "grey";
  return dataset;
}

StereoFiles FilesOf(const Dataset& dataset) {
  return StereoFilesOf(dataset.frames, [](const std::string&) {
    return Image{std::vector<unsigned char>(320 * 240, 128), 320, 240, 1};
  });
}

TEST(LiftsBoxes, OnlyWhereDetectionsAreMadeFromBoxes) {
  EXPECT_TRUE(LiftsBoxes({false, true, "boxes.txt", false}, {}));
  EXPECT_FALSE(LiftsBoxes({true, false, "boxes.txt", false}, {}));
  EXPECT_FALSE(LiftsBoxes({false, true, "", false}, {})) << "no detector: the frontend says so";
  EXPECT_TRUE(MeasuresByStereo({true, false, "", false}, {})) << "odometry does";
}

TEST(InspectImages, SaysWhatTheImagesAreFor) {
  Dataset dataset = Pairs();
  ImageSource source = InspectImages({}, {}, FilesOf(dataset), dataset);
  EXPECT_FALSE(source.lifted_boxes || source.stereo_odometry || source.alignment_range_m);
  EXPECT_TRUE(source.has_detections);
  source = InspectImages({true, true, "b", true}, {}, FilesOf(dataset), dataset);
  EXPECT_TRUE(source.lifted_boxes && source.stereo_odometry && source.alignment_range_m);
  EXPECT_FALSE(source.row_error_rad) << "no texture";
  dataset.detections_path = "detections.txt";
  EXPECT_FALSE(InspectImages({}, {}, FilesOf(dataset), dataset).has_detections) << "no rows";
  dataset.rows_read = 1;
  EXPECT_TRUE(InspectImages({}, {}, FilesOf(dataset), dataset).has_detections);
}

TEST(InspectImages, WithoutASecondCameraThereIsNothingToLookAt) {
  Dataset dataset = Pairs();
  dataset.camera_right.reset();
  EXPECT_FALSE(
      InspectImages({true, false, "", true}, {}, FilesOf(dataset), dataset).alignment_range_m);
}

TEST(MakeImageSequence, TakesFramesAndBoxesAndWarnsOfBoxesBeyondTheEnd) {
  const TempFolder folder;
  const std::string boxes =
      folder.Write("boxes.txt", "0 Car 0.9 1 1 9 9\n3 Car 0.9 1 1 9 9\n7 Car 0.9 1 1 9 9\n");
  std::vector<std::string> log;
  const LogSink before =
      SetLogSink([&](LogLevel, const std::string& line) { log.push_back(line); });
  Dataset dataset = Pairs();
  const ImageSequence sequence = MakeImageSequence({true, true, boxes, false}, dataset);
  SetLogSink(before);
  EXPECT_EQ(sequence.frames.size(), 3u);
  EXPECT_TRUE(dataset.frames.empty());
  EXPECT_TRUE(sequence.odometry && sequence.detections);
  EXPECT_EQ(sequence.boxes->size(), 3u);
  EXPECT_EQ(sequence.camera.baseline_m, 0.5);
  ASSERT_EQ(log.size(), 1u);
  EXPECT_NE(log[0].find("boxes of 2 frames after the last one (2)"), std::string::npos) << log[0];
}

TEST(MakeImageSequence, NeedsBothCameras) {
  Dataset dataset = Pairs();
  dataset.camera_right.reset();
  ExpectError(
      [&] {
        MakeImageSequence({true, false, "", false}, dataset);
      },
      {"drive", "calib.txt"});
}

TEST(MakeGroundAligner, NoneWhereNothingCanBeAligned) {
  const ImageRequest asked{false, false, "", true};
  Dataset dataset = Pairs();
  EXPECT_TRUE(MakeGroundAligner(asked, dataset, {}, FilesOf(dataset), {}));
  EXPECT_FALSE(MakeGroundAligner(ImageRequest(), dataset, {}, FilesOf(dataset), {}));
  Dataset other = dataset;
  other.camera_right->fx = 300;  // no pair
  EXPECT_FALSE(MakeGroundAligner(asked, other, {}, FilesOf(other), {}));
  other = dataset;
  other.camera_right.reset();
  EXPECT_FALSE(MakeGroundAligner(asked, other, {}, FilesOf(other), {}));
  other = dataset;
  for (Frame& frame : other.frames) frame.image_right.clear();
  EXPECT_FALSE(MakeGroundAligner(asked, other, {}, FilesOf(other), {}));
}

TEST(NextFrame, KeepsAnErrorAfterTheFirstFrame) {
  Dataset dataset = Pairs();
  ImageSequence sequence = MakeImageSequence({true, false, "", false}, dataset);
  int loaded = 0;
  const auto load = [&](const std::string&) {  // the second frame's right image has another size
    const int width = ++loaded == 4 ? 160 : 320;
    return Image{std::vector<unsigned char>(static_cast<std::size_t>(width) * 240, 128), width, 240,
                 1};
  };
  ImageFrontend frontend(std::move(sequence), {}, {}, {load}, 1);
  std::optional<Error> failure;
  EXPECT_TRUE(NextFrame(frontend, 0, failure));
  EXPECT_FALSE(NextFrame(frontend, 1, failure));
  ASSERT_TRUE(failure);
  EXPECT_EQ(failure->kind(), ErrorKind::kBadInput);
}

}  // namespace
}  // namespace sslcd
