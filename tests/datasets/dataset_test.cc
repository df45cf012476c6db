// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/datasets/dataset.h"

#include <cmath>

#include "formats/npy.h"
#include "temp_folder.h"

namespace sslcd {
namespace {

using testing::Contains;
using testing::HasSubstr;

const char kCalib[] = "P2: 700 0 600 0 0 700 180 0 0 0 1 0\n";

/// `count` poses, a metre apart along z, every `step` seconds.
std::string Tum(int count, double step = 0.1) {
  std::string text;
  for (int i = 0; i < count; ++i)
    text += std::to_string(i * step) + " 0 0 " + std::to_string(i) + " 0 0 0 1\n";
  return text;
}
std::string Kitti(int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += "1 0 0 0 0 1 0 0 0 0 1 " + std::to_string(i) + "\n";
  return text;
}
std::string Times(int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += std::to_string(i * 0.1) + "\n";
  return text;
}
std::string Row(int frame, const std::string& label = "Car") {
  return std::to_string(frame) + " -1 " + label + " -1 -1 -10 -1 -1 -1 -1 1.5 2 4 1 2 10 0 0.9\n";
}

/// A sequence folder of four frames; each test spoils a part of it.
class SequenceFolder : public testing::Test {
 protected:
  SequenceFolder() {
    folder_.Write("times.txt", Times(4));
    folder_.Write("odometry.txt", Tum(4));
    folder_.Write("detections.txt", Row(0) + Row(0, "DontCare") + Row(2));
    request_.path = folder_.path();
  }
  Dataset Load() const { return LoadDataset(request_); }
  void Refuse(const std::vector<std::string>& parts) const {
    ExpectError([this] { Load(); }, parts);
  }

  TempFolder folder_;
  DatasetRequest request_;
};

TEST_F(SequenceFolder, LoadsTheLeastThereCanBe) {
  const Dataset dataset = Load();
  EXPECT_EQ(dataset.format, "sequence");
  ASSERT_EQ(dataset.frames.size(), 4u);
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(dataset.frames[i].index, i);
    EXPECT_NEAR(dataset.frames[i].stamp, 0.1 * i, 1e-9);
    EXPECT_EQ(dataset.frames[i].T_odom_cam.translation(), Vec3(0, 0, i));
    EXPECT_TRUE(dataset.frames[i].image_left.empty());
  }
  ASSERT_EQ(dataset.frames[2].detections.size(), 1u);
  EXPECT_EQ(dataset.frames[2].detections[0].row, 2);
  EXPECT_EQ(dataset.rows_read, 3);
  EXPECT_EQ(dataset.rows_dont_care, 1);
  EXPECT_FALSE(dataset.camera.has_value());
  EXPECT_FALSE(dataset.groundtruth.has_value());
  EXPECT_EQ(dataset.odometry_format, PoseFormat::kTum);
  EXPECT_THAT(dataset.warnings, testing::IsEmpty());
}

TEST_F(SequenceFolder, LoadsAllParts) {
  folder_.Write("calib.txt", kCalib);
  folder_.Write("groundtruth.txt", Kitti(4));
  folder_.Write("sequence.yaml", "up_axis: [0, 0, 1]\nlabels: {Car: {symmetry: pi}}\n");
  folder_.Write("image_2/000001.png", "not a picture");
  const Dataset dataset = Load();
  EXPECT_EQ(dataset.camera->fx, 700);
  EXPECT_EQ(dataset.up_axis, Vec3(0, 0, 1));
  EXPECT_EQ(dataset.labels["Car"].symmetry, Symmetry::kPi);
  ASSERT_TRUE(dataset.groundtruth.has_value());
  EXPECT_EQ(dataset.groundtruth->size(), 4u);
  EXPECT_NEAR(dataset.groundtruth->stamps[3], 0.3, 1e-9) << "rows without stamps get the frames'";
  EXPECT_TRUE(dataset.frames[0].image_left.empty());
  EXPECT_THAT(dataset.frames[1].image_left, HasSubstr("image_2/000001.png"));
}

/// The beginning of an image file, up to its size.
std::string Png(int width, int height) {
  std::string head("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\0\0\0\0\0", 24);
  head[18] = static_cast<char>(width >> 8);
  head[19] = static_cast<char>(width);
  head[22] = static_cast<char>(height >> 8);
  head[23] = static_cast<char>(height);
  return head;
}

TEST_F(SequenceFolder, ImageSizeComesFromTheImages) {
  folder_.Write("calib.txt", kCalib);
  folder_.Write("image_2/000000.png", Png(1280, 720));
  const Dataset dataset = Load();
  EXPECT_EQ(dataset.camera->width, 1280);
  EXPECT_EQ(dataset.camera->height, 720);
}

TEST_F(SequenceFolder, ABrokenImageDoesNotSayHowLargeTheOthersAre) {
  folder_.Write("calib.txt", kCalib);
  folder_.Write("image_2/000000.png", Png(30000, 30000));
  for (int i = 1; i < 4; ++i)
    folder_.Write("image_2/00000" + std::to_string(i) + ".png", Png(640, 480));
  EXPECT_EQ(Load().camera->width, 640);
  folder_.Write("image_2/000000.png", "none");
  EXPECT_EQ(Load().camera->width, 640);
}

TEST_F(SequenceFolder, JpegsHaveASizeToo) {
  folder_.Write("calib.txt", kCalib);
  const std::string app0("\xFF\xE0\0\x04xy", 6), frame("\xFF\xC2\0\x11\x08\x01\x77\x04\xDA", 9);
  folder_.Write("image_2/000000.jpg", "\xFF\xD8" + app0 + frame);
  const Dataset dataset = Load();
  EXPECT_EQ(dataset.camera->width, 1242);
  EXPECT_EQ(dataset.camera->height, 375);
  for (const std::string& broken :
       {std::string("\xFF\xD8", 2), "\xFF\xD8" + app0, std::string("\xFF\xD8\xFF\xE0\0\0", 6)}) {
    folder_.Write("image_2/000000.jpg", broken);
    EXPECT_EQ(Load().camera->width, 0);
  }
}

TEST_F(SequenceFolder, ASizeThatIsNotTheImagesIsAnError) {
  folder_.Write("calib.txt", kCalib);
  folder_.Write("image_2/000000.png", Png(1280, 720));
  folder_.Write("sequence.yaml", "image_size_px: [640, 360]\n");
  ExpectError([this] { Load(); }, {"sequence.yaml", "640x360", "1280x720"});
  folder_.Write("sequence.yaml", "image_size_px: [1280, 720]\n");
  EXPECT_EQ(Load().camera->width, 1280);
}

TEST_F(SequenceFolder, ImagesAfterTheLastPoseAreLeftOutAloud) {
  for (int i = 0; i < 6; ++i) folder_.Write("image_2/00000" + std::to_string(i) + ".png", "");
  const Dataset dataset = Load();
  EXPECT_EQ(dataset.frames.size(), 4u);
  EXPECT_THAT(dataset.warnings, testing::Contains(HasSubstr("2 more images")));
  request_.max_frames = 2;
  EXPECT_THAT(Load().warnings, testing::Contains(HasSubstr("2 more images")))
      << "of the file, not of what is asked for";
}

TEST_F(SequenceFolder, MaxFramesCutsQuietly) {
  folder_.Write("groundtruth.txt", Kitti(4));
  request_.max_frames = 2;
  const Dataset dataset = Load();
  EXPECT_EQ(dataset.frames.size(), 2u);
  EXPECT_EQ(dataset.groundtruth->size(), 2u);
  EXPECT_EQ(dataset.rows_beyond_end, 0);
  EXPECT_THAT(dataset.warnings, testing::IsEmpty());
}

TEST_F(SequenceFolder, OdometryMayRunFasterThanTheFrames) {
  folder_.Write("odometry.txt", Tum(9, 0.05));
  const Dataset dataset = Load();
  ASSERT_EQ(dataset.frames.size(), 4u);
  EXPECT_EQ(dataset.frames[3].T_odom_cam.translation(), Vec3(0, 0, 6));
  EXPECT_THAT(dataset.warnings, Contains(HasSubstr("1 poses come after the last")));
}

TEST_F(SequenceFolder, OdometryMayReportItsUncertainty) {
  folder_.Write("odometry.txt",
                "0 0 0 0 0 0 0 1 9 9\n0.1 0 0 1 0 0 0 1\n0.2 0 0 2 0 0 0 1 0.3 0.01\n"
                "0.3 0 0 2 0 0 0 1 lost\n");
  const Dataset dataset = Load();
  EXPECT_FALSE(dataset.frames[0].step.has_value()) << "there is no step to the first frame";
  EXPECT_FALSE(dataset.frames[1].step.has_value());
  ASSERT_TRUE(dataset.frames[2].step.has_value());
  EXPECT_EQ(dataset.frames[2].step->translation_m, 0.3);
  EXPECT_EQ(dataset.frames[2].step->rotation_rad, 0.01);
  ASSERT_TRUE(dataset.frames[3].step.has_value());
  EXPECT_TRUE(dataset.frames[3].step->lost);
}

TEST_F(SequenceFolder, UncertaintiesOfAFasterOdometryAddUp) {
  std::string odometry;
  for (int i = 0; i < 16; ++i) {  // four rows a frame
    odometry += std::to_string(i * 0.025) + " 0 0 " + std::to_string(i) + " 0 0 0 1";
    odometry += i == 1 || i == 4 ? " 0.3 0.1\n" : i == 3 ? " 0.4 0\n" : i == 10 ? " lost\n" : "\n";
  }
  folder_.Write("odometry.txt", odometry);
  const Dataset dataset = Load();
  ASSERT_TRUE(dataset.frames[1].step.has_value());
  EXPECT_NEAR(dataset.frames[1].step->translation_m, std::sqrt(0.09 + 0.09 + 0.16), 1e-12);
  EXPECT_NEAR(dataset.frames[1].step->rotation_rad, std::sqrt(0.02), 1e-12);
  EXPECT_FALSE(dataset.frames[2].step.has_value());
  ASSERT_TRUE(dataset.frames[3].step.has_value());
  EXPECT_TRUE(dataset.frames[3].step->lost);
}

TEST_F(SequenceFolder, EveryFrameNeedsAPose) {
  folder_.Write("odometry.txt", Tum(3));
  Refuse({"odometry.txt", "no pose for frame 3 at 0.300 s", "4 stamps", "3 stamps"});
  folder_.Write("odometry.txt", Kitti(5));
  Refuse({"odometry.txt: has 5 poses", "times.txt has 4 stamps"});
  folder_.Write("odometry.txt", "");
  Refuse({"odometry.txt: holds no poses"});
  folder_.Write("odometry.txt", "1000 0 0 0 0 0 0 1\n");
  Refuse({"no pose for frame 0", "1000.000 s"});
}

TEST_F(SequenceFolder, StampsComeFromTheOdometryWhereThereAreNoTimes) {
  std::filesystem::remove(folder_.path() + "/times.txt");
  folder_.Write("odometry.txt", Tum(4, 0.5));
  EXPECT_NEAR(Load().frames[3].stamp, 1.5, 1e-9);
  folder_.Write("odometry.txt", Kitti(4));
  EXPECT_NEAR(Load().frames[3].stamp, 0.3, 1e-9);
}

TEST_F(SequenceFolder, VinsWorldsHaveZUp) {
  folder_.Write("odometry.txt",
                "0,0,0,0,1,0,0,0\n100000000,0,0,0,1,0,0,0\n200000000,0,0,0,1,0,0,0\n300000000,0,0,"
                "0,1,0,0,0\n");
  const Dataset dataset = Load();
  EXPECT_EQ(dataset.up_axis, Vec3(0, 0, 1));
  EXPECT_THAT(dataset.warnings, Contains(HasSubstr("taken as the camera's")));
  folder_.Write("sequence.yaml", "up_axis: [0, -1, 0]\n");
  EXPECT_EQ(Load().up_axis, Vec3(0, -1, 0));
}

TEST_F(SequenceFolder, StampsMustIncrease) {
  folder_.Write("times.txt", "0\n0.1\n0.1\n0.3\n");
  Refuse({"times.txt:3: stamp 0.1", "must increase"});
  folder_.Write("times.txt", "0\n0.2\n0.1\n0.3\n");
  Refuse({"times.txt:3: stamp 0.1", "must increase"});
  folder_.Write("times.txt", "0\nnan\n");
  Refuse({"times.txt:2: the stamp is not finite"});
  folder_.Write("times.txt", "0 1\n");
  Refuse({"times.txt:1: found 2 columns"});
  folder_.Write("times.txt", "");
  Refuse({"times.txt: holds no stamps"});
}

TEST_F(SequenceFolder, GapsAreWarnedOf) {
  folder_.Write("times.txt", "0\n0.1\n0.2\n9\n");
  folder_.Write("odometry.txt", Kitti(4));
  EXPECT_THAT(Load().warnings,
              Contains(HasSubstr("1 gap(s) in the stamps, the first of 8.800 s before frame 3")));
}

TEST_F(SequenceFolder, DetectionsAfterTheLastPoseAreDropped) {
  folder_.Write("detections.txt", Row(3) + Row(4) + Row(1000000000));
  const Dataset dataset = Load();
  EXPECT_EQ(dataset.rows_beyond_end, 2);
  EXPECT_EQ(dataset.frames[3].detections.size(), 1u);
  EXPECT_THAT(dataset.warnings,
              Contains(HasSubstr("dropped 2 detections of frames after the last pose (3)")));
}

TEST_F(SequenceFolder, RunsWithoutDetectionsAndSaysSo) {
  folder_.Write("detections.txt", "");
  const Dataset dataset = Load();
  EXPECT_EQ(dataset.frames.size(), 4u);
  EXPECT_THAT(dataset.warnings, Contains(HasSubstr("no detections")));
}

TEST_F(SequenceFolder, UnknownLabelsAreWarnedOf) {
  folder_.Write("sequence.yaml", "labels: {Tree: {symmetry: full}}\n");
  EXPECT_THAT(Load().warnings, Contains(HasSubstr("not among its labels: Car")));
}

TEST_F(SequenceFolder, EmbeddingsBelongToRows) {
  const std::string header = "{'descr': '<f4', 'fortran_order': False, 'shape': (3, 2), }\n";
  const float values[] = {3, 4, 9, 9, 0, 0};
  std::string npy =
      std::string("\x93NUMPY\x01\0", 8) + static_cast<char>(header.size()) + '\0' + header;
  npy.append(reinterpret_cast<const char*>(values), sizeof(values));
  folder_.Write("embeddings.npy", npy);
  const Dataset dataset = Load();
  EXPECT_THAT(dataset.frames[0].detections[0].appearance[Cue::kEmbedding],
              testing::ElementsAre(0.6f, 0.8f));
  EXPECT_TRUE(dataset.frames[2].detections[0].appearance[Cue::kEmbedding].empty());
  EXPECT_THAT(dataset.warnings, Contains(HasSubstr("left out 1 embedding(s)")));
  folder_.Write("detections.txt", Row(0));
  Refuse({"embeddings.npy", "has 3 rows", "has 1"});
}

TEST_F(SequenceFolder, ColoursBelongToRows) {
  folder_.Write("colours.npy", NpyBytes({3, 2, {3, 4, 9, 9, 1, 0}}));
  EXPECT_THAT(Load().frames[0].detections[0].appearance[Cue::kColour],
              testing::ElementsAre(0.6f, 0.8f));
  folder_.Write("colours.npy", NpyBytes({3, 2, {3, 4, 9, 9, 0, 0}}));
  Refuse({"colours.npy", "1 colour vector(s)", "remove the file"});
  folder_.Write("colours.npy", NpyBytes({2, 2, {3, 4, 9, 9}}));
  Refuse({"colours.npy", "has 2 rows", "has 3"});
}

TEST_F(SequenceFolder, MissingPartsAreNamed) {
  std::filesystem::remove(folder_.path() + "/detections.txt");
  Refuse({"no detections here", "--detections", "detections.txt"});
  folder_.Write("detections/000002.txt", "Car -1 -1 -10 -1 -1 -1 -1 1.5 2 4 1 2 10 0\n");
  EXPECT_EQ(Load().frames[2].detections.size(), 1u);
  std::filesystem::remove(folder_.path() + "/odometry.txt");
  Refuse({"no odometry here", "--odometry"});
  request_.odometry = "nowhere.txt";
  Refuse({"odometry 'nowhere.txt' is neither in"});
}

TEST_F(SequenceFolder, SequencesMayLieSideBySide) {
  const TempFolder parent;
  parent.Write("a/odometry.txt", Tum(2));
  parent.Write("a/detections.txt", Row(1));
  parent.Write("b/odometry.txt", Tum(3));
  request_.path = parent.path();
  Refuse({"not a dataset folder", "sequences inside, name one: a, b"});
  request_.sequence = "a";
  EXPECT_EQ(Load().frames.size(), 2u);
  request_.sequence = "c";
  ExpectError([this] { Load(); }, {"a, b"});
}

TEST(Dataset, UnknownFoldersSayWhatWasLookedFor) {
  const TempFolder folder;
  DatasetRequest request;
  request.path = folder.path();
  ExpectError([&] { LoadDataset(request); },
              {"times.txt", "sequences/", "oxts/data/", "label_02/"});
  request.path += "/none";
  ExpectError([&] { LoadDataset(request); }, {"none: no such folder"});
}

TEST(Dataset, FormatsHaveNames) {
  EXPECT_THAT(DatasetFormatNames(), testing::ElementsAre("auto", "sequence", "kitti-odometry",
                                                         "kitti-raw", "kitti-tracking"));
  const TempFolder folder;
  DatasetRequest request;
  request.path = folder.path();
  request.format = "kitti";
  ExpectError([&] { LoadDataset(request); },
              {"no dataset format 'kitti'; there are: auto, sequence, kitti-odometry"});
}

}  // namespace
}  // namespace sslcd
