// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/check_input.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "sslcd/core/error.h"
#include "sslcd/pipeline/options.h"

namespace sslcd {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Frame FrameAt(int index, double stamp, double z) {
  Frame frame;
  frame.index = index;
  frame.stamp = stamp;
  frame.T_odom_cam = Pose::Trans(0, 0, z);
  return frame;
}

void ExpectRefused(const std::function<void()>& call, const std::string& word) {
  try {
    call();
    FAIL() << "taken: " << word;
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kBadInput);
    EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
  }
}

TEST(CheckFrame, ABadFrameIsRefusedAndTheMapperStaysAsItWas) {
  Mapper mapper({}, {});
  mapper.AddFrame(FrameAt(5, 1, 0));
  const auto add = [&](const Frame& frame) { return [&mapper, frame] { mapper.AddFrame(frame); }; };
  ExpectRefused(add(FrameAt(5, 2, 1)), "number");
  ExpectRefused(add(FrameAt(4, 2, 1)), "number");
  ExpectRefused(add(FrameAt(6, 1, 1)), "StartSequence");
  ExpectRefused(add(FrameAt(6, kNan, 1)), "not finite");
  ExpectRefused(add(FrameAt(6, 2, kNan)), "not finite");
  ExpectRefused(add(FrameAt(6, 2, 1e200)), "Earth");
  Frame longer = FrameAt(6, 2, 1);
  longer.T_odom_cam.data()[3] = 1.1;
  ExpectRefused(add(longer), "quaternion");
  Frame frame = FrameAt(6, 2, 1);
  frame.step = StepUncertainty{false, -1, 0};
  ExpectRefused(add(frame), "step");
  EXPECT_EQ(mapper.CameraTrajectory().size(), 1u);
  EXPECT_NO_THROW(mapper.AddFrame(FrameAt(6, 2, 1)));
}

TEST(CheckFrame, ANewSequenceMayStartAtAnyTimeButNotWithOldNumbers) {
  Mapper mapper({}, {});
  mapper.AddFrame(FrameAt(0, 100, 0));
  mapper.StartSequence();
  ExpectRefused([&] { mapper.AddFrame(FrameAt(0, 3, 0)); }, "number");
  EXPECT_NO_THROW(mapper.AddFrame(FrameAt(1, 3, 0))) << "the refused frame was not its first";
  ExpectRefused([&] { mapper.AddFrame(FrameAt(2, 3, 1)); }, "stamp");
  EXPECT_NO_THROW(mapper.AddFrame(FrameAt(2, 3.1, 1)));
  EXPECT_EQ(mapper.CameraTrajectory().stamps, (std::vector<double>{100, 3, 3.1}));
}

TEST(CheckContext, NamesWhatIsWrong) {
  MapperContext context;
  EXPECT_NO_THROW(Mapper({}, context));
  context.gravity.up.setZero();
  ExpectRefused([&] { Mapper({}, context); }, "gravity");
  context.gravity = GravityFrame::FromUp({0, 0, 1});
  context.camera = Camera();
  ExpectRefused([&] { Mapper({}, context); }, "focal");
  context.camera->fx = context.camera->fy = kNan;
  ExpectRefused([&] { Mapper({}, context); }, "focal");
  context.camera->fx = context.camera->fy = 700;
  EXPECT_NO_THROW(Mapper({}, context));
}

TEST(CheckContext, AnUpDirectionOfNoLengthIsNone) {
  ExpectRefused([] { GravityFrame::FromUp({0, 0, 0}); }, "up direction");
  ExpectRefused([] { GravityFrame::FromUp({0, kNan, 0}); }, "up direction");
}

TEST(RigidFromMatrix, TakesRotationsOnly) {
  const Eigen::Matrix3d R = lie::SO3<double>::RotY(1).matrix();
  ASSERT_TRUE(RigidFromMatrix(R, Vec3(1, 2, 3)).has_value());
  EXPECT_LT((RigidFromMatrix(R, Vec3(1, 2, 3))->so3().matrix() - R).norm(), 1e-12);
  EXPECT_TRUE(RigidFromMatrix(R * 1.001, Vec3::Zero()).has_value()) << "rounding";
  EXPECT_FALSE(RigidFromMatrix(2 * R, Vec3::Zero()).has_value());
  EXPECT_FALSE(RigidFromMatrix(-R, Vec3::Zero()).has_value());
  EXPECT_FALSE(RigidFromMatrix(R, Vec3(0, kNan, 0)).has_value());
}

}  // namespace
}  // namespace sslcd
