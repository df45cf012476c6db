// SPDX-License-Identifier: BSD-3-Clause
#include "check/headings.h"

#include <gmock/gmock.h>

#include "drive.h"

namespace sslcd::check {
namespace {

using testing::ElementsAre;

double Sign(double ry) { return -ry; }
double Quarter(double ry) { return WrapAngle(ry + M_PI / 2); }
double Half(double ry) { return WrapAngle(ry + M_PI); }
double Degrees(double ry) { return ry * 180 / M_PI; }

TEST(Headings, EachIsNamedAndCorrected) {
  EXPECT_EQ(IdOf(CheckHeadings(MakeDrive())), "ok");
  const std::pair<const char*, double (*)(double)> mistakes[] = {{"heading_sign", Sign},
                                                                 {"heading_quarter_turn", Quarter},
                                                                 {"heading_half_turn", Half},
                                                                 {"heading_degrees", Degrees}};
  for (const auto& [id, change] : mistakes) {
    Sequence s = MakeDrive();
    ChangeCuboids(s, [change = change](FileCuboid& c) { c.rotation_y = change(c.rotation_y); });
    EXPECT_THAT(BeforeAndAfter(CheckHeadings, s), ElementsAre(id, "ok"));
  }
}

TEST(Headings, WithoutAlphaTheBoxesTell) {
  Sequence s = MakeDrive();
  for (Row& row : s.rows) row.written.alpha = -10;
  EXPECT_EQ(IdOf(CheckHeadings(s)), "ok");
  ChangeCuboids(s, [](FileCuboid& c) { c.rotation_y = Quarter(c.rotation_y); });
  EXPECT_THAT(BeforeAndAfter(CheckHeadings, s), ElementsAre("heading_quarter_turn", "ok"));
}

TEST(Headings, AWrongAlphaAloneIsNoMistake) {
  Sequence s = MakeDrive();
  for (Row& row : s.rows) row.written.alpha = row.written.rotation_y;
  EXPECT_EQ(IdOf(CheckHeadings(s)), "ok");
}

TEST(Headings, NoneOrFew) {
  Sequence s = MakeDrive();
  ChangeCuboids(s, [](FileCuboid& c) { c.rotation_y = 0; });
  EXPECT_EQ(IdOf(CheckHeadings(s)), "no_heading");
  s.rows.resize(29);
  EXPECT_EQ(IdOf(CheckHeadings(s)), "not testable");
  s = MakeDrive();
  s.labels.Set("Car", {Symmetry::kFull});
  EXPECT_EQ(IdOf(CheckHeadings(s)), "not testable");
}

}  // namespace
}  // namespace sslcd::check
