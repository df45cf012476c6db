// SPDX-License-Identifier: BSD-3-Clause
// What an AsyncMapper does with frames that come too fast.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <future>
#include <optional>

#include "loop_drives.h"
#include "sslcd/pipeline/async_mapper.h"
#include "sslcd/pipeline/options.h"

namespace sslcd {
namespace {

// A host's matcher that waits for a sign, and with it the mapper's thread.
class Gate {
 public:
  PlaceMatcher Matcher() {
    return [this](const PlaceQuery&) {
      reached_ = true;
      opened_.wait();
      return std::optional<PlaceAnswer>();
    };
  }
  bool reached() const { return reached_; }
  void Open() { open_.set_value(); }

 private:
  std::atomic<bool> reached_{false};
  std::promise<void> open_;
  std::shared_future<void> opened_{open_.get_future()};
};

// A mapper that waits in the host's matcher, with a full queue.
class StalledMapper : public testing::Test {
 protected:
  static constexpr int kMost = 3;

  static Options SearchesOnce() {
    Options options;
    options.loop.layout.every_m = 200;  // once in the second lap
    return options;
  }
  MapperContext WithGate() {
    MapperContext context = drives_.Context();
    context.place_matcher = gate_.Matcher();
    return context;
  }
  void SetUp() override {
    int done = 0;
    while (!gate_.reached()) {
      ASSERT_TRUE(async_.AddFrame(drives_.frames.at(next_++)));
      while (done < static_cast<int>(next_) && !gate_.reached()) done += async_.TakeReport().frames;
    }
    for (int i = 0; i < kMost; ++i) EXPECT_TRUE(async_.AddFrame(drives_.frames[next_++]));
  }
  // Lets the mapper go on and hands in two frames. Returns the first of them, the step to which
  // spans what was dropped.
  const Frame& GoOn() {
    EXPECT_FALSE(async_.WaitFor(0.001));
    gate_.Open();
    EXPECT_TRUE(async_.WaitFor(60));
    const std::size_t after = next_;
    for (int i = 0; i < 2; ++i) EXPECT_TRUE(async_.AddFrame(drives_.frames[next_++]));
    async_.Wait();
    return drives_.frames[after];
  }

  const Drives drives_ = TwoLaps(SecondLap::kSame, 0.5, 1);
  Gate gate_;
  AsyncMapper async_{SearchesOnce(), WithGate(), kMost};
  std::size_t next_ = 0;
};

TEST_F(StalledMapper, DropsWhatIsTooMuch) {
  Frame lost = drives_.frames[next_++];
  lost.step = StepUncertainty{true};
  EXPECT_FALSE(async_.AddFrame(lost));
  EXPECT_FALSE(async_.AddFrame(drives_.frames[next_++]));
  const Frame& after = GoOn();
  const AsyncReport report = async_.TakeReport();
  EXPECT_EQ(report.dropped, 2);
  EXPECT_EQ(report.failure, "");
  EXPECT_EQ(async_.TakeReport().dropped, 0);
  ASSERT_FALSE(after.detections.empty());
  int of_lost = 0, of_next = 0;
  for (const MapObject& object : async_.Snapshot().get().Objects()) {
    for (const Observation& observation : object.observations) {
      of_lost += observation.frame == after.index;
      of_next += observation.frame == after.index + 1;
    }
  }
  EXPECT_EQ(of_lost, 0) << "a lost step makes its detections useless";
  EXPECT_GT(of_next, 0);
}

TEST_F(StalledMapper, AStepOverManyDroppedFramesIsNoFailureOfOdometry) {
  constexpr int kDropped = 60;
  for (int i = 0; i < kDropped; ++i) EXPECT_FALSE(async_.AddFrame(drives_.frames[next_++]));
  const int after = GoOn().index;
  int found = 0;
  for (const PoseGraph::Edge& edge : async_.Snapshot().get().Graph().edges)
    if (edge.to == after) {
      ++found;
      EXPECT_GT(edge.T_from_to.translation().norm(), 40) << "as unsure as that if taken for a jump";
      EXPECT_LT(std::sqrt(1 / edge.information(2, 2)), 10);
    }
  EXPECT_EQ(found, 1);
}

}  // namespace
}  // namespace sslcd
