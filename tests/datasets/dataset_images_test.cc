// SPDX-License-Identifier: BSD-3-Clause
// Sequences whose odometry or detections are to be made from images: PartPolicy.
#include <string>

#include "sslcd/datasets/dataset.h"
#include "temp_folder.h"

namespace sslcd {
namespace {

using testing::Contains;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;

const char kCalib[] =
    "P2: 700 0 600 0 0 700 180 0 0 0 1 0\nP3: 700 0 600 -350 0 700 180 0 0 0 1 0\n";
const char kRow[] = "1 -1 Car -1 -1 -10 -1 -1 -1 -1 1.5 2 4 1 2 10 0 0.9\n";
const char kPoses[] = "0 1 2 3 0 0 0 1\n0.5 1 2 4 0 0 0 1\n1 1 2 5 0 0 0 1\n";

/// A folder with calibration and three pairs of images, of which nobody looks at more than the
/// names.
class Images : public testing::Test {
 protected:
  Images() {
    folder_.Write("calib.txt", kCalib);
    for (int i = 0; i < 3; ++i) WritePair(i, ".png");
    request_.path = folder_.path();
    request_.odometry_policy = request_.detections_policy = PartPolicy::kIfThere;
  }
  void WritePair(int frame, const std::string& ending) {
    for (const char* name : {"image_2", "image_3"})
      folder_.Write(name + ("/00000" + std::to_string(frame)) + ending, "picture");
  }
  void Remove(const std::string& name) { std::filesystem::remove_all(folder_.path() + "/" + name); }
  Dataset Load() const { return LoadDataset(request_); }

  TempFolder folder_;
  DatasetRequest request_;
};

TEST_F(Images, AreEnough) {
  const Dataset dataset = Load();
  EXPECT_EQ(dataset.format, "sequence");
  EXPECT_THAT(dataset.warnings, IsEmpty());
  EXPECT_EQ(dataset.odometry_path, "");
  EXPECT_EQ(dataset.detections_path, "");
  EXPECT_EQ(dataset.up_axis, Vec3(0, -1, 0));
  ASSERT_TRUE(dataset.camera && dataset.camera_right);
  EXPECT_NEAR(MakeStereoCamera(*dataset.camera, *dataset.camera_right).baseline_m, 0.5, 1e-12);
  ASSERT_EQ(dataset.frames.size(), 3u);
  for (int i = 0; i < 3; ++i) {
    const Frame& frame = dataset.frames[i];
    EXPECT_EQ(frame.index, i);
    EXPECT_NEAR(frame.stamp, 0.1 * i, 1e-12);
    EXPECT_EQ(frame.T_odom_cam.translation(), Vec3(0, 0, 0));
    EXPECT_THAT(frame.detections, IsEmpty());
    EXPECT_THAT(frame.image_left, EndsWith("image_2/00000" + std::to_string(i) + ".png"));
    EXPECT_THAT(frame.image_right, EndsWith("image_3/00000" + std::to_string(i) + ".png"));
  }
  request_.max_frames = 2;
  EXPECT_EQ(Load().frames.size(), 2u);
}

TEST_F(Images, AloneMayLackFramesButNotTenThousand) {
  folder_.Write("image_2/010002.png", "picture");
  folder_.Write("image_3/010002.png", "picture");
  EXPECT_EQ(Load().frames.size(), 10003u);
  folder_.Write("image_2/010005.png", "picture");
  ExpectError([&] { Load(); }, {"010005.png: is not a frame number, as the last of 5 images"});
}

TEST_F(Images, InColourAreTakenBeforeGreyOnes) {
  const std::string rows = "700 0 600 0 0 700 180 0 0 0 1 0\n700 0 600 -280 0 700 180 0 0 0 1 0\n";
  for (const auto& [left, right] :
       {std::pair("image_0", "image_1"), {"image_l", "image_r"}, {"left", "right"}}) {
    folder_.Write(left + std::string("/000000.png"), "picture");
    folder_.Write(right + std::string("/000000.png"), "picture");
    EXPECT_THAT(Load().frames[0].image_left, EndsWith("image_2/000000.png"));
    Remove("image_2");
    folder_.Write("calib.txt", rows);
    const Dataset grey = Load();
    ASSERT_EQ(grey.frames.size(), 1u);
    EXPECT_THAT(grey.frames[0].image_left, EndsWith(std::string(left) + "/000000.png"));
    EXPECT_THAT(grey.frames[0].image_right, EndsWith(std::string(right) + "/000000.png"));
    EXPECT_NEAR(MakeStereoCamera(*grey.camera, *grey.camera_right).baseline_m, 0.4, 1e-12);
    Remove(left);
    Remove(right);
    folder_.Write("calib.txt", kCalib);
    WritePair(0, ".png");
  }
}

TEST_F(Images, GreyPairsAreTakenOnlyWhole) {
  folder_.Write("image_0/000000.png", "picture");
  Remove("image_3");
  folder_.Write("odometry.txt", kPoses);
  folder_.Write("detections.txt", kRow);
  EXPECT_THAT(Load().frames[0].image_left, EndsWith("image_2/000000.png")) << "image_1 is missing";
}

TEST_F(Images, AreNotEnoughWherePartsAreNeeded) {
  request_.odometry_policy = PartPolicy::kNeeded;
  ExpectError([this] { Load(); }, {"no odometry here", "--odometry"});
  folder_.Write("odometry.txt", kPoses);
  EXPECT_EQ(Load().frames.size(), 3u);
  request_.detections_policy = PartPolicy::kNeeded;
  ExpectError([this] { Load(); }, {"no detections here", "--detections"});
}

TEST_F(Images, WithoutThemPartsAreMissing) {
  Remove("image_3");
  ExpectError([this] { Load(); }, {"no odometry here", "odometry.txt", "image_3"});
  folder_.Write("odometry.txt", kPoses);
  ExpectError([this] { Load(); }, {"no detections here", "detections.txt", "image_3"});
  folder_.Write("detections.txt", kRow);
  EXPECT_EQ(Load().frames.size(), 3u) << "nothing has to be made";
}

TEST_F(Images, PartsThatAreThereAreRead) {
  folder_.Write("odometry.txt", kPoses);
  folder_.Write("detections.txt", kRow);
  const Dataset dataset = Load();
  EXPECT_EQ(dataset.frames[2].T_odom_cam.translation(), Vec3(1, 2, 5));
  EXPECT_NEAR(dataset.frames[2].stamp, 1, 1e-12);
  EXPECT_EQ(dataset.frames[1].detections.size(), 1u);
}

TEST_F(Images, IgnoredPartsMayHoldAnything) {
  for (const char* name : {"odometry.txt", "detections.txt", "embeddings.npy", "colours.npy"})
    folder_.Write(name, "no such thing");
  EXPECT_THROW(Load(), Error);
  request_.odometry_policy = request_.detections_policy = PartPolicy::kIgnored;
  const Dataset dataset = Load();
  EXPECT_EQ(dataset.frames.size(), 3u);
  EXPECT_EQ(dataset.odometry_path + dataset.detections_path, "");
  EXPECT_EQ(dataset.rows_read, 0);
}

TEST_F(Images, StampsAfterTheLastImageAreNoFrames) {
  folder_.Write("times.txt", "7\n7.5\n8\n8.5\n100\n");
  const Dataset dataset = Load();
  ASSERT_EQ(dataset.frames.size(), 3u);
  EXPECT_EQ(dataset.frames[1].stamp, 7.5);
  EXPECT_THAT(dataset.warnings, Contains(HasSubstr("5 stamps, but images of 3 frames only")));
}

TEST_F(Images, OneThatIsMissingDoesNotShiftTheOthers) {
  Remove("image_2/000001.png");
  folder_.Write("image_2/thumbs.db", "no image");
  const Dataset dataset = Load();
  ASSERT_EQ(dataset.frames.size(), 3u);
  EXPECT_THAT(dataset.frames[1].image_left, IsEmpty());
  EXPECT_THAT(dataset.frames[1].image_right, EndsWith("000001.png"));
  EXPECT_THAT(dataset.frames[2].image_left, EndsWith("000002.png"));
}

TEST_F(Images, FoldersMayBeEmpty) {
  for (const char* name : {"image_2", "image_3"}) {
    Remove(name);
    std::filesystem::create_directory(folder_.path() + "/" + name);
  }
  ExpectError([this] { Load(); }, {"no frames", "times.txt", "image_2"});
  folder_.Write("times.txt", "");
  ExpectError([this] { Load(); }, {"no frames"});
}

TEST_F(Images, AreNotNamedByNumberAndByTime) {
  folder_.Write("image_2/1403636579.png", "picture");
  ExpectError([this] { Load(); }, {"image_2/000000.png", "frame number, others by stamps"});
}

class StampedImages : public Images {
 protected:
  StampedImages() {
    Remove("image_2");
    Remove("image_3");
    for (const char* name : {"1403636579763000000", "1403636579863000000", "1403636579963000000"}) {
      folder_.Write("left/" + std::string(name) + ".BMP", "picture");
      folder_.Write("right/" + std::string(name) + ".BMP", "picture");
    }
  }
};

TEST_F(StampedImages, AreEnough) {
  const Dataset dataset = Load();
  ASSERT_EQ(dataset.frames.size(), 3u);
  EXPECT_NEAR(dataset.frames[1].stamp, 1403636579.863, 1e-6);
  EXPECT_THAT(dataset.frames[1].image_left, EndsWith("left/1403636579863000000.BMP"));
  EXPECT_THAT(dataset.frames[1].image_right, EndsWith("right/1403636579863000000.BMP"));
  EXPECT_THAT(dataset.warnings, IsEmpty());
}

TEST_F(StampedImages, RightOnesMayBeMillisecondsOff) {
  Remove("right/1403636579863000000.BMP");
  folder_.Write("right/1403636579866000000.BMP", "picture");
  EXPECT_THAT(Load().frames[1].image_right, EndsWith("right/1403636579866000000.BMP"));
  Remove("right/1403636579866000000.BMP");
  folder_.Write("right/1403636579870000000.BMP", "picture");
  EXPECT_EQ(Load().frames[1].image_right, "") << "7 ms";
}

TEST_F(StampedImages, BelongToOdometryByStamp) {
  folder_.Write("odometry.txt",
                "1403636579.863 1 2 3 0 0 0 1\n1403636579.96 1 2 4 0 0 0 1\n"
                "1403636580.5 1 2 5 0 0 0 1\n1403636580.6 1 2 5 0 0 0 1\n");
  const Dataset dataset = Load();
  ASSERT_EQ(dataset.frames.size(), 4u);
  EXPECT_THAT(dataset.frames[0].image_left, EndsWith("left/1403636579863000000.BMP"));
  EXPECT_THAT(dataset.frames[1].image_right, EndsWith("right/1403636579963000000.BMP"));
  EXPECT_EQ(dataset.frames[2].image_left, "");
}

TEST_F(StampedImages, GiveStampsToPosesWithout) {
  const std::string row = "1 0 0 0 0 1 0 0 0 0 1 0\n";
  folder_.Write("odometry.txt", row + row + row);
  EXPECT_NEAR(Load().frames[2].stamp, 1403636579.963, 1e-6);
  folder_.Write("odometry.txt", row + row);
  ExpectError([this] { Load(); },
              {"odometry.txt: has 2 poses without stamps", "left has 3 images"});
  folder_.Write("times.txt", "5\n6\n7\n");
  folder_.Write("odometry.txt", row + row + row);
  EXPECT_THAT(Load().frames[2].image_left, EndsWith("left/1403636579963000000.BMP"))
      << "in order, where there are as many";
}

TEST_F(Images, WithNamesWithoutNumbers) {
  Remove("image_2");
  folder_.Write("image_2/first.png", "picture");
  ExpectError([this] { Load(); }, {"no frames", "image_2 have names without a number"});
}

TEST_F(Images, OfOneCameraAreNotEnough) {
  Remove("image_3");
  ExpectError([this] { Load(); }, {"image_2: one camera shows no distances", "image_3"});
}

TEST(ImagesOf, FoldersOfOtherNamesAreNamed) {
  const TempFolder folder;
  folder.Write("cam0/000000.png", "");
  folder.Write("cam1/000000.png", "");
  DatasetRequest request;
  request.path = folder.path();
  ExpectError([&] { LoadDataset(request); },
              {"It holds images in cam0/, cam1/", "left/", "right/", "calib.txt"});
  request.path = folder.In("cam0");
  ExpectError([&] { LoadDataset(request); }, {"It holds images itself"});
}

TEST_F(Images, MayBeJpegs) {
  Remove("image_2/000001.png");
  Remove("image_3/000001.png");
  WritePair(1, ".jpg");
  WritePair(3, ".jpg");
  const Dataset dataset = Load();
  ASSERT_EQ(dataset.frames.size(), 4u);
  EXPECT_THAT(dataset.frames[1].image_left, EndsWith("image_2/000001.jpg"));
  EXPECT_THAT(dataset.frames[3].image_right, EndsWith("image_3/000003.jpg"));
  EXPECT_EQ(dataset.camera->width, 0) << "not known where no image tells";
}

Dataset LoadFromImages(const TempFolder& folder) {
  DatasetRequest request;
  request.path = folder.path();
  request.odometry_policy = request.detections_policy = PartPolicy::kIfThere;
  return LoadDataset(request);
}

TEST(ImagesOf, KittiOdometry) {
  const TempFolder folder;
  folder.Write("sequences/00/calib.txt", kCalib);
  folder.Write("sequences/00/image_2/000000.png", "");
  folder.Write("sequences/00/image_3/000000.png", "");
  const Dataset dataset = LoadFromImages(folder);
  EXPECT_EQ(dataset.format, "kitti-odometry");
  ASSERT_EQ(dataset.frames.size(), 1u);
  EXPECT_THAT(dataset.frames[0].image_left, EndsWith("sequences/00/image_2/000000.png"));
  EXPECT_THAT(dataset.frames[0].image_right, EndsWith("sequences/00/image_3/000000.png"));
}

TEST(ImagesOf, KittiTracking) {
  const TempFolder folder;
  folder.Write("calib/0003.txt", kCalib);
  folder.Write("image_02/0003/000000.jpg", "");
  folder.Write("image_03/0003/000000.jpg", "");
  const Dataset dataset = LoadFromImages(folder);
  EXPECT_EQ(dataset.format, "kitti-tracking");
  ASSERT_EQ(dataset.frames.size(), 1u);
  EXPECT_THAT(dataset.frames[0].image_left, EndsWith("image_02/0003/000000.jpg"));
  EXPECT_THAT(dataset.frames[0].image_right, EndsWith("image_03/0003/000000.jpg"));
  EXPECT_EQ(dataset.camera->width, 1242) << "that of the dataset, where the image does not tell";
}

TEST(ImagesOf, KittiRaw) {
  const TempFolder folder;
  folder.Write("oxts/timestamps.txt", "2011-09-26 13:02:25.0\n2011-09-26 13:02:25.25\n");
  folder.Write("oxts/data/0000000000.txt", "not read");
  folder.Write("image_02/data/0000000001.png", "");
  folder.Write("image_03/data/0000000001.png", "");
  DatasetRequest request;
  request.path = folder.path();
  request.odometry_policy = request.detections_policy = PartPolicy::kIgnored;
  const Dataset dataset = LoadDataset(request);
  EXPECT_EQ(dataset.format, "kitti-raw");
  ASSERT_EQ(dataset.frames.size(), 2u);
  EXPECT_NEAR(dataset.frames[1].stamp - dataset.frames[0].stamp, 0.25, 1e-9);
  EXPECT_THAT(dataset.frames[0].image_left, IsEmpty());
  EXPECT_THAT(dataset.frames[1].image_left, EndsWith("image_02/data/0000000001.png"));
  EXPECT_THAT(dataset.frames[1].image_right, EndsWith("image_03/data/0000000001.png"));
}

TEST(ImagesOf, KittiRawInGreyAndNothingElse) {
  const TempFolder folder;
  folder.Write("image_00/timestamps.txt", "2011-09-26 13:02:25.0\n2011-09-26 13:02:25.25\n");
  for (const char* name : {"image_00", "image_01"})
    for (const char* file : {"/data/0000000000.png", "/data/0000000001.png"})
      folder.Write(name + std::string(file), "");
  folder.Write("calib_cam_to_cam.txt",
               "S_rect_00: 1242 375\nP_rect_00: 700 0 600 0 0 700 180 0 0 0 1 0\n"
               "P_rect_01: 700 0 600 -280 0 700 180 0 0 0 1 0\n");
  const Dataset dataset = LoadFromImages(folder);
  EXPECT_EQ(dataset.format, "kitti-raw");
  ASSERT_EQ(dataset.frames.size(), 2u);
  EXPECT_THAT(dataset.frames[1].image_right, EndsWith("image_01/data/0000000001.png"));
  EXPECT_NEAR(dataset.frames[1].stamp - dataset.frames[0].stamp, 0.25, 1e-9);
  EXPECT_NEAR(MakeStereoCamera(*dataset.camera, *dataset.camera_right).baseline_m, 0.4, 1e-12);
}

}  // namespace
}  // namespace sslcd
