// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/sim/write_sequence.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "sslcd/core/error.h"

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
    folder_ = fs::path(testing::TempDir()) / ("sslcd_" + std::to_string(getpid()) + "_" + test->name());
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
    EXPECT_EQ(Read(entry.path()), Read(folder_ / "a" / "deep" / entry.path().filename())) << entry.path();
    EXPECT_FALSE(Read(entry.path()).empty());
  }
  EXPECT_EQ(files, 7);
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

TEST_F(WriteSequenceTest, FolderThatCannotBe) {
  std::ofstream(folder_) << "a file";
  EXPECT_EQ(KindOfFailure(folder_), ErrorKind::kOutput);
  EXPECT_EQ(KindOfFailure(folder_ / "below"), ErrorKind::kOutput);
}

}  // namespace
}  // namespace sslcd::sim
