// SPDX-License-Identifier: BSD-3-Clause
#include "datasets/sequence_writer.h"

#include "sslcd/core/pose.h"
#include "sslcd/datasets/dataset.h"
#include "temp_folder.h"

namespace sslcd {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

Detection Car(double x, double z, double yaw) {
  Detection car;
  car.label = "Car";
  car.score = 0.875;
  car.T_cam_object = ToPose({Vec3(x, 1, z), yaw}, GravityFrame());
  car.dims = {4, 1.75, 1.5};
  return car;
}

/// Three frames: two cars, none, one car.
SequenceFiles Street() {
  SequenceFiles files;
  files.comment = "three frames";
  files.camera = StereoCamera{{700, 710, 600, 180, {0.06, -0.01, 0.002}, 0, 0}, 0.54, -0.4};
  for (int i = 0; i < 3; ++i) {
    files.odometry.stamps.push_back(1.5e9 + 0.1 * i);
    files.odometry.poses.push_back(Pose::Trans(0.1, 0.2, i) * Pose::RotY(0.3 * i));
  }
  files.detections = {{Car(2, 10, 0.5), Car(-3, 12, -2)}, {}, {Car(0, 8, 3)}};
  files.detections[0][0].box = Box2d{10, 20, 110.25, 60};
  files.up_axis = {0, -0.6, -0.8};
  files.labels.Set("Car", {Symmetry::kPi});
  files.labels.Set("Tree", {Symmetry::kFull});
  return files;
}

class SequenceWriter : public testing::Test {
 protected:
  Dataset WriteAndLoad() const {
    WriteSequenceFiles(folder_.path(), files_);
    DatasetRequest request;
    request.path = folder_.path();
    return LoadDataset(request);
  }
  bool Has(const char* name) const { return std::filesystem::exists(folder_.path() + "/" + name); }

  TempFolder folder_;
  SequenceFiles files_ = Street();
};

TEST_F(SequenceWriter, WhatIsWrittenIsRead) {
  const Dataset dataset = WriteAndLoad();
  EXPECT_EQ(dataset.format, "sequence");
  EXPECT_THAT(dataset.warnings, IsEmpty());
  EXPECT_LT((dataset.up_axis - files_.up_axis).norm(), 1e-9);
  EXPECT_EQ(dataset.labels["Car"].symmetry, Symmetry::kPi);
  EXPECT_EQ(dataset.labels["Tree"].symmetry, Symmetry::kFull);
  ASSERT_EQ(dataset.frames.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const Frame& frame = dataset.frames[i];
    EXPECT_NEAR(frame.stamp, files_.odometry.stamps[i], 1e-6);
    EXPECT_LT((frame.T_odom_cam.inverse() * files_.odometry.poses[i]).Log().norm(), 1e-8);
    ASSERT_EQ(frame.detections.size(), files_.detections[i].size());
    for (std::size_t k = 0; k < frame.detections.size(); ++k) {
      const Detection &read = frame.detections[k], &written = files_.detections[i][k];
      EXPECT_EQ(read.label, "Car");
      EXPECT_NEAR(read.score, written.score, 5e-4);
      EXPECT_LT((read.T_cam_object.inverse() * written.T_cam_object).Log().norm(), 2e-4);
      EXPECT_LT((read.dims - written.dims).norm(), 1e-4);
      EXPECT_EQ(read.appearance, PerCue<std::vector<float>>());
    }
  }
  EXPECT_EQ(dataset.frames[2].detections[0].row, 2);
}

TEST_F(SequenceWriter, ABoxThatIsNotThereStaysAway) {
  const Dataset dataset = WriteAndLoad();
  const std::vector<Detection>& first = dataset.frames[0].detections;
  ASSERT_TRUE(first[0].box);
  EXPECT_NEAR(first[0].box->right, 110.25, 1e-9);
  EXPECT_FALSE(first[1].box);
}

TEST_F(SequenceWriter, CamerasComeBack) {
  const Dataset dataset = WriteAndLoad();
  ASSERT_TRUE(dataset.camera && dataset.camera_right);
  const StereoCamera read = MakeStereoCamera(*dataset.camera, *dataset.camera_right);
  EXPECT_EQ(read.left.fy, 710);
  EXPECT_LT((read.left.offset - files_.camera->left.offset).norm(), 1e-9);
  EXPECT_NEAR(read.baseline_m, 0.54, 1e-9);
  EXPECT_NEAR(read.disparity_at_infinity, -0.4, 1e-9);
  files_.camera.reset();
  EXPECT_FALSE(WriteAndLoad().camera) << "calib.txt of before is gone";
}

TEST_F(SequenceWriter, TheImagesSizeComesBack) {
  EXPECT_EQ(WriteAndLoad().camera->width, 0) << "not known";
  files_.camera->left.width = 1242;
  files_.camera->left.height = 375;
  const Dataset dataset = WriteAndLoad();
  EXPECT_EQ(dataset.camera->width, 1242);
  EXPECT_EQ(dataset.camera_right->height, 375);
}

TEST_F(SequenceWriter, GroundTruthComesBackBesideTheOdometry) {
  EXPECT_FALSE(WriteAndLoad().groundtruth);
  files_.groundtruth = files_.odometry;
  for (Pose& pose : files_.groundtruth->poses) pose = Pose::Trans(0.5, 0, 0) * pose;
  const Dataset dataset = WriteAndLoad();
  ASSERT_TRUE(dataset.groundtruth);
  ASSERT_EQ(dataset.groundtruth->size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_LT((dataset.groundtruth->poses[i].inverse() * files_.groundtruth->poses[i]).Log().norm(),
              1e-8);
    EXPECT_LT((dataset.frames[i].T_odom_cam.inverse() * files_.odometry.poses[i]).Log().norm(),
              1e-8);
  }
  files_.groundtruth.reset();
  EXPECT_FALSE(WriteAndLoad().groundtruth) << "groundtruth.txt of before is gone";
}

TEST_F(SequenceWriter, EachCueIsReadAsItWasWritten) {
  for (const CueRow& row : kCueRows) {
    files_ = Street();
    files_.detections[0][0].appearance[row.cue] = {0.6f, 0.8f};
    files_.detections[0][1].appearance[row.cue] = {0, 1};
    files_.detections[2][0].appearance[row.cue] = {1, 0};
    const Dataset dataset = WriteAndLoad();
    EXPECT_THAT(dataset.warnings, IsEmpty()) << row.name;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < files_.detections[i].size(); ++k)
        EXPECT_EQ(dataset.frames[i].detections[k].appearance, files_.detections[i][k].appearance)
            << row.name;
    for (const CueRow& other : kCueRows)
      EXPECT_EQ(Has(other.file), other.cue == row.cue) << other.name << " was there before";
  }
}

TEST_F(SequenceWriter, SomeCuesMayHaveGaps) {
  for (const CueRow& row : kCueRows) {
    files_ = Street();
    files_.detections[2][0].appearance[row.cue] = {1, 0};
    const Dataset dataset = WriteAndLoad();
    EXPECT_EQ(Has(row.file), !row.complete) << row.name;
    EXPECT_THAT(dataset.frames[0].detections[0].appearance[row.cue], IsEmpty()) << row.name;
    EXPECT_EQ(dataset.frames[2].detections[0].appearance[row.cue].empty(), row.complete)
        << row.name;
  }
}

TEST_F(SequenceWriter, WhatAnEarlierRunLeftGoes) {
  files_.detections[0][0].appearance[Cue::kEmbedding] = {1, 0};
  WriteAndLoad();
  EXPECT_TRUE(Has("embeddings.npy"));
  files_.detections[0][0].appearance[Cue::kEmbedding].clear();
  files_.detections[2].clear();
  EXPECT_EQ(WriteAndLoad().rows_read, 2);
  EXPECT_FALSE(Has("embeddings.npy")) << "it would have a row too many";
  folder_.Write("embeddings.npy/in_the_way", "");
  try {
    WriteAndLoad();
    ADD_FAILURE() << "a folder that is not empty cannot go";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kOutput);
    EXPECT_THAT(error.what(), testing::HasSubstr("embeddings.npy: cannot be removed"));
  }
}

TEST_F(SequenceWriter, NothingSeenIsASequenceToo) {
  files_.detections.assign(3, {});
  const Dataset dataset = WriteAndLoad();
  EXPECT_EQ(dataset.frames.size(), 3u);
  EXPECT_EQ(dataset.rows_read, 0);
}

TEST_F(SequenceWriter, FoldersWithSomethingInThemAreKept) {
  const std::string path = folder_.path() + "/a/b";
  EXPECT_NO_THROW(static_cast<void>(PrepareSequenceFolder(path, false)))
      << "made, with the folders on the way";
  EXPECT_NO_THROW(static_cast<void>(PrepareSequenceFolder(path, false))) << "still empty";
  folder_.Write("a/b/notes.txt", "precious");
  try {
    static_cast<void>(PrepareSequenceFolder(path, false));
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kUsage);
    EXPECT_THAT(error.what(), testing::HasSubstr("not empty"));
  }
  EXPECT_NO_THROW(static_cast<void>(PrepareSequenceFolder(path, true)));
  EXPECT_TRUE(Has("a/b/notes.txt"));
}

}  // namespace
}  // namespace sslcd
