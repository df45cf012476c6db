// SPDX-License-Identifier: BSD-3-Clause
#include "sim/write_sequence.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "sslcd/core/error.h"
#include "sslcd/datasets/dataset.h"

namespace sslcd::sim {
namespace {

namespace fs = std::filesystem;

std::string Read(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

class WriteSequenceTest : public testing::Test {
 protected:
  void SetUp() override {
    const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ =
        fs::path(testing::TempDir()) / ("sslcd_" + std::to_string(getpid()) + "_" + test->name());
    StreetOptions options;
    options.frames = 40;
    world_ = MakeStreet(3, options);
    odometry_ = SimulateOdometry(world_.truth, {}, 4);
    detections_ = SimulateDetections(world_, {}, 5);
  }
  void TearDown() override { fs::remove_all(folder_); }

  void Write(const fs::path& folder, bool overwrite = false) {
    WriteSequence(world_, odometry_, detections_, folder, overwrite);
  }

  ErrorKind KindOfFailure(const fs::path& folder) {
    try {
      Write(folder);
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(folder.string()), std::string::npos) << error.what();
      return error.kind();
    }
    ADD_FAILURE() << "no error";
    return ErrorKind::kNoSolution;
  }

  fs::path folder_;
  World world_;
  Trajectory odometry_;
  SimulatedDetections detections_;
};

TEST_F(WriteSequenceTest, SameBytesEveryTimeAndNoTemporaries) {
  Write(folder_ / "a" / "deep");
  Write(folder_ / "b");
  int files = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_ / "b")) {
    ++files;
    EXPECT_EQ(Read(entry.path()), Read(folder_ / "a" / "deep" / entry.path().filename()))
        << entry.path();
    EXPECT_FALSE(Read(entry.path()).empty());
  }
  EXPECT_EQ(files, 7);
}

TEST_F(WriteSequenceTest, TheReaderGetsItAllBack) {
  Write(folder_);
  DatasetRequest request;
  request.path = folder_.string();
  const Dataset dataset = LoadDataset(request);

  EXPECT_EQ(dataset.format, "sequence");
  EXPECT_TRUE(dataset.warnings.empty()) << dataset.warnings.front();
  EXPECT_EQ(dataset.up_axis, world_.gravity.up);
  EXPECT_EQ(dataset.labels["Pole"].symmetry, Symmetry::kFull);
  EXPECT_EQ(dataset.labels["Car"].symmetry, Symmetry::kNone);
  ASSERT_TRUE(dataset.camera);
  EXPECT_NEAR(dataset.camera->fx, world_.camera.fx, 1e-6);
  EXPECT_NEAR(dataset.camera->cy, world_.camera.cy, 1e-6);
  EXPECT_NEAR((dataset.camera->offset - world_.camera.offset).norm(), 0, 1e-9);
  EXPECT_EQ(static_cast<std::size_t>(dataset.rows_read), detections_.identity.size());
  EXPECT_EQ(dataset.rows_dropped, 0);

  const auto difference = [](const Pose& a, const Pose& b) {
    return (a.inverse() * b).Log().norm();
  };
  ASSERT_TRUE(dataset.groundtruth);
  ASSERT_EQ(dataset.frames.size(), world_.truth.size());
  ASSERT_EQ(dataset.groundtruth->size(), world_.truth.size());
  for (std::size_t i = 0; i < dataset.frames.size(); ++i) {
    const Frame& frame = dataset.frames[i];
    EXPECT_NEAR(frame.stamp, world_.truth.stamps[i], 1e-6);
    EXPECT_LT(difference(frame.T_odom_cam, odometry_.poses[i]), 1e-6);
    EXPECT_LT(difference(dataset.groundtruth->poses[i], world_.truth.poses[i]), 1e-6);
    ASSERT_EQ(frame.detections.size(), detections_.frames[i].size());
    for (std::size_t k = 0; k < frame.detections.size(); ++k) {
      const Detection &read = frame.detections[k], &written = detections_.frames[i][k];
      EXPECT_EQ(read.row, written.row);
      EXPECT_EQ(read.label, written.label);
      EXPECT_NEAR(read.score, written.score, 1e-3);
      EXPECT_LT(difference(read.T_cam_object, written.T_cam_object), 1e-3);
      EXPECT_LT((read.dims - written.dims).norm(), 1e-3);
      ASSERT_EQ(read.box.has_value(), written.box.has_value());
      if (read.box) {
        EXPECT_GT(Iou(*read.box, *written.box), 0.98);
      }
    }
  }
}

TEST_F(WriteSequenceTest, RefusesAFolderThatIsNotEmpty) {
  fs::create_directories(folder_);
  std::ofstream(folder_ / "mine.txt") << "precious";
  EXPECT_EQ(KindOfFailure(folder_), ErrorKind::kUsage);
  EXPECT_FALSE(fs::exists(folder_ / "times.txt"));
  Write(folder_, true);
  EXPECT_TRUE(fs::exists(folder_ / "times.txt"));
  EXPECT_EQ(Read(folder_ / "mine.txt"), "precious");
}

TEST_F(WriteSequenceTest, LeavesNoVectorsOfAnotherWorld) {
  for (auto& frame : detections_.frames)
    for (Detection& detection : frame) detection.appearance[Cue::kEmbedding] = {1, 0};
  Write(folder_);
  EXPECT_TRUE(fs::exists(folder_ / "embeddings.npy"));
  for (auto& frame : detections_.frames)
    for (Detection& detection : frame) detection.appearance[Cue::kEmbedding].clear();
  Write(folder_, true);
  EXPECT_FALSE(fs::exists(folder_ / "embeddings.npy"));
}

TEST_F(WriteSequenceTest, FolderThatCannotBe) {
  std::ofstream(folder_) << "a file";
  EXPECT_EQ(KindOfFailure(folder_), ErrorKind::kOutput);
  EXPECT_EQ(KindOfFailure(folder_ / "below"), ErrorKind::kOutput);
}

}  // namespace
}  // namespace sslcd::sim
