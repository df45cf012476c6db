// SPDX-License-Identifier: BSD-3-Clause
#include "benchmark/viewpoint.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "sim/write_sequence.h"
#include "sslcd/core/error.h"

namespace sslcd::benchmark {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

Trial At(const std::string& range) {
  Trial trial;
  trial.place = PlaceAtViewpoint(range);
  trial.case_number = 4;
  return trial;
}

TEST(Viewpoint, PassesMeetAtAnAngleOfTheRange) {
  const Trial trial = At("100-110");
  EXPECT_EQ(trial.World(), "lot-v100-110-c4-s1");
  EXPECT_EQ(trial.place.cases, std::vector<int>{4});
  const double degrees = MakeSequence(trial).scene.viewpoint_rad * 180 / M_PI;
  EXPECT_GE(degrees, 100);
  EXPECT_LE(degrees, 110);
}

TEST(Viewpoint, KeyframesCountOnTheWayBack) {
  Trial trial = At("60-75");
  trial.method = Select(Methods(), {"no_loops"})[0];
  const sim::HalvSequence sequence = MakeSequence(trial);
  const std::vector<Revisit> counted = RunTrial(trial, sequence).revisits;
  trial.place.way_back_only = false;
  const std::vector<Revisit> all = RunTrial(trial, sequence).revisits;
  ASSERT_FALSE(counted.empty());
  EXPECT_GT(all.size(), counted.size());
  EXPECT_LT(all.front().frame, sequence.scene.return_frame);
  EXPECT_GE(counted.front().frame, sequence.scene.return_frame);
  EXPECT_EQ(counted.back().frame, all.back().frame);
}

TEST(Viewpoint, RangesOfTheTableGoAllTheWayRound) {
  const std::vector<std::string> ranges = ViewpointRanges();
  double end = 0;
  for (const std::string& range : ranges) {
    EXPECT_EQ(PlaceAtViewpoint(range).scene.viewpoint_low_deg, end);
    end = PlaceAtViewpoint(range).scene.viewpoint_high_deg;
  }
  EXPECT_EQ(end, 180);
}

TEST(Viewpoint, RefusesWhatIsNoRange) {
  for (const char* range : {"", "-", "45", "45-", "-60", "60-45", "60-60", "45-60-75", "45-190",
                            "-10-20", "7.5-15", "a-b", "nan-20"})
    EXPECT_THROW(PlaceAtViewpoint(range), Error) << range;
}

class RenderedTest : public testing::Test {
 protected:
  // As --render leaves it, but for the images.
  void Write(const Trial& world, const std::string& name) const {
    const sim::HalvSequence sequence = MakeSequence(world);
    const std::filesystem::path folder = std::filesystem::path(root_) / name;
    sim::WriteSequence(sequence.scene.world, sequence.odometry, sequence.detections, folder, true);
    std::filesystem::create_directory(folder / "image_2");
  }
  std::string Complaint(const Trial& trial) const {
    try {
      CheckRendered(root_, {trial});
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kBadInput);
      return error.what();
    }
    return "";
  }
  void SetUp() override { std::filesystem::remove_all(root_); }
  void TearDown() override { std::filesystem::remove_all(root_); }

  // Its own for each test: ctest runs them at the same time.
  const std::string root_ = testing::TempDir() + "sslcd_" + std::to_string(getpid()) + "_" +
                            testing::UnitTest::GetInstance()->current_test_info()->name();
};

TEST_F(RenderedTest, TakesTheRightWorld) {
  const Trial trial = At("45-60");
  Write(trial, trial.World());
  EXPECT_EQ(Complaint(trial), "");
}

TEST_F(RenderedTest, SaysHowToMakeTheOneThatIsMissing) {
  EXPECT_THAT(Complaint(At("45-60")),
              HasSubstr("sslcd_sim halv --case 4 --seed 1 --viewpoint-low-deg 45 "
                        "--viewpoint-high-deg 60 --render --out " +
                        root_ + "/lot-v45-60-c4-s1"));
  Trial plain;
  plain.seed = 3;
  EXPECT_THAT(Complaint(plain), HasSubstr("--case 1 --seed 3 --render"));
}

TEST_F(RenderedTest, RefusesAnotherWorldOfThatName) {
  const Trial trial = At("45-60");
  Write(At("60-75"), trial.World());
  EXPECT_THAT(Complaint(trial), HasSubstr("of another world"));
  std::filesystem::remove(std::filesystem::path(root_) / trial.World() / "groundtruth.txt");
  EXPECT_THAT(Complaint(trial),
              AllOf(HasSubstr("groundtruth.txt"), HasSubstr("make it with: sslcd_sim"),
                    Not(HasSubstr("of another world"))));
}

}  // namespace
}  // namespace sslcd::benchmark
