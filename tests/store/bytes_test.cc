// SPDX-License-Identifier: BSD-3-Clause
#include "store/bytes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "../support/temp_folder.h"
#include "store/frame_bytes.h"

namespace sslcd {
namespace {

TEST(Bytes, NumbersComeBackBitByBit) {
  const double reals[] = {-0., std::numeric_limits<double>::quiet_NaN(),
                          std::numeric_limits<double>::denorm_min(), -1e300};
  const std::string text = ByteWriter()
                               .Byte(255)
                               .Int(-2)
                               .Long(std::numeric_limits<std::int64_t>::min())
                               .Float(-0.f)
                               .Reals(reals, 4)
                               .Text(std::string("a\0b", 3))
                               .Take();
  ByteReader bytes(text);
  EXPECT_EQ(bytes.Byte(), 255);
  EXPECT_EQ(bytes.Int(), -2);
  EXPECT_EQ(bytes.Long(), std::numeric_limits<std::int64_t>::min());
  EXPECT_TRUE(std::signbit(bytes.Float()));
  EXPECT_TRUE(std::signbit(bytes.Real()));
  EXPECT_TRUE(std::isnan(bytes.Real()));
  EXPECT_EQ(bytes.Real(), reals[2]);
  EXPECT_EQ(bytes.Real(), reals[3]);
  EXPECT_EQ(bytes.Text(), std::string("a\0b", 3));
  bytes.ExpectEnd();
}

TEST(Bytes, NothingIsReadBeyondTheEnd) {
  ExpectError([] { ByteReader("abc").Int(); }, {"is cut short"});
  ExpectError([] { ByteReader(ByteWriter().Int(5).Byte(1).Take()).Text(); }, {"impossible length"});
  ExpectError([] { ByteReader(ByteWriter().Int(-1).Take()).Text(); }, {"impossible length"});
  ExpectError([] { ByteReader("a").ExpectEnd(); }, {"too long"});
}

TEST(FrameBytes, AFrameComesBackWhole) {
  Frame frame;
  frame.index = 7;
  frame.stamp = 12.5;
  frame.T_odom_cam = Pose(lie::SO3<double>::RotX(0.3), Vec3(-0., 1, 2));
  frame.step = StepUncertainty{true, 0.1, 0.2};
  Detection detection;
  detection.row = 3;
  detection.label = "Car";
  detection.score = std::numeric_limits<double>::quiet_NaN();
  detection.dims = Vec3(4, 2, 1);
  detection.box = Box2d{1, 2, 3, 4};
  detection.appearance[Cue::kEmbedding] = {0.5f, -0.f};
  frame.detections = {detection, Detection()};
  const std::string text = FrameBytes(frame);
  const Frame read = FrameOf(text);
  EXPECT_EQ(FrameBytes(read), text);
  EXPECT_EQ(read.index, 7);
  EXPECT_TRUE(std::signbit(read.T_odom_cam.translation().x()));
  EXPECT_TRUE(read.step->lost);
  EXPECT_EQ(read.step->rotation_rad, 0.2);
  EXPECT_EQ(read.detections[0].label, "Car");
  EXPECT_EQ(read.detections[0].box->bottom, 4);
  EXPECT_EQ(read.detections[0].appearance[Cue::kEmbedding].size(), 2u);
  EXPECT_FALSE(read.detections[1].box);
  EXPECT_THROW(FrameOf(text.substr(0, text.size() - 1)), Error);
  EXPECT_THROW(FrameOf(text + "x"), Error);
}

TEST(FrameBytes, ARefinementComesBackWhole) {
  RefinementInput refinement{Refinement::kOnTheWay, {{1, 2, std::nullopt}, {3, 4, RelativePose()}}};
  refinement.views[1].T_a_b->covariance(0, 5) = 7;
  const std::string text = RefinementBytes(refinement);
  const RefinementInput read = RefinementOf(text);
  EXPECT_EQ(RefinementBytes(read), text);
  EXPECT_EQ(read.when, Refinement::kOnTheWay);
  EXPECT_FALSE(read.views[0].T_a_b);
  EXPECT_EQ(read.views[1].b_frame, 4);
  EXPECT_EQ(read.views[1].T_a_b->covariance(0, 5), 7);
}

}  // namespace
}  // namespace sslcd
