// SPDX-License-Identifier: BSD-3-Clause
#include "check/boxes.h"

#include <gmock/gmock.h>

#include "drive.h"

namespace sslcd::check {
namespace {

using testing::ElementsAre;

TEST(Boxes, SizesPlacesAndFormats) {
  EXPECT_EQ(IdOf(CheckBoxes(MakeDrive())), "ok");
  Sequence s = MakeDrive();
  ChangeCuboids(s, [](FileCuboid& c) { std::swap(c.h, c.l); });
  EXPECT_THAT(BeforeAndAfter(CheckBoxes, s), ElementsAre("size_order", "ok"));
  s = MakeDrive();
  ChangeCuboids(s, [](FileCuboid& c) { c.bottom.y() -= 0.5 * c.h; });
  EXPECT_THAT(BeforeAndAfter(CheckBoxes, s), ElementsAre("box_centre", "ok"));
  s = MakeDrive();
  for (Row& row : s.rows) {
    Box2d& b = row.written.box;
    b = {b.left, b.top, b.right - b.left, b.bottom - b.top};
    row.detection.box = b.Area() > 0 ? std::optional<Box2d>(b) : std::nullopt;
  }
  EXPECT_THAT(BeforeAndAfter(CheckBoxes, s), ElementsAre("box_format", "ok"));
}

TEST(Boxes, Cameras) {
  Sequence s = MakeDrive();
  s.camera->fx *= 10;
  s.camera->fy *= 10;
  EXPECT_THAT(BeforeAndAfter(CheckBoxes, s), ElementsAre("focal_length", "ok"));
  s = MakeDrive();
  s.camera->offset.x() = -1;
  EXPECT_THAT(BeforeAndAfter(CheckBoxes, s), ElementsAre("wrong_camera", "ok"));
  s = MakeDrive();
  s.camera.reset();
  EXPECT_EQ(IdOf(CheckBoxes(s)), "no_calibration");
  for (Row& row : s.rows) row.detection.box.reset();
  EXPECT_EQ(IdOf(CheckBoxes(s)), "not testable");
}

TEST(Boxes, FewOrNone) {
  Sequence s = MakeDrive();
  s.rows.resize(kLeastBoxes - 1);
  EXPECT_EQ(IdOf(CheckBoxes(s)), "not testable");
}

}  // namespace
}  // namespace sslcd::check
