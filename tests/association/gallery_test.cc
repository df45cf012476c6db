// SPDX-License-Identifier: BSD-3-Clause
#include "association/gallery.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sslcd {
namespace {

using Vector = std::vector<float>;

TEST(Gallery, MeanIsTheMeanOfAllDotProducts) {  // Eqs. 5 and 6
  Gallery gallery(Gallery::Mode::kMean);
  const std::vector<Vector> seen = {{1, 0}, {0.6f, 0.8f}, {0.8f, 0.6f}};
  for (const Vector& v : seen) gallery.Add(v, 1.);
  const Vector query = {0.28f, 0.96f};
  double mean = 0;
  for (const Vector& v : seen) mean += (query[0] * v[0] + query[1] * v[1]) / seen.size();
  EXPECT_NEAR(*gallery.Compare(query, -2.), mean, 1e-6);
}

TEST(Gallery, ADirectionThatIsNoneIsNotSeen) {
  Gallery gallery(Gallery::Mode::kByViewpoint);
  gallery.Add({0, 1}, std::nan(""));
  EXPECT_FALSE(gallery.Compare({0, 1}, 0.).has_value());
  gallery.Add({1, 0}, 0.1);
  EXPECT_NEAR(*gallery.Compare({1, 0}, 0.1), 1., 1e-6);
  EXPECT_FALSE(gallery.Compare({1, 0}, std::nan("")).has_value());
}

TEST(Gallery, TheOtherSideDoesNotDiluteThisOne) {
  Gallery gallery(Gallery::Mode::kByViewpoint);
  for (int i = 0; i < 100; ++i) gallery.Add({1, 0}, 0.1);
  gallery.Add({0, 1}, M_PI);
  EXPECT_NEAR(*gallery.Compare({0, 1}, M_PI), 1., 1e-6);
  EXPECT_NEAR(*gallery.Compare({1, 0}, 0.1), 1., 1e-6);
  EXPECT_NEAR(*gallery.Compare({0, 1}, M_PI - 0.5), 1., 1e-6)
      << "the nearest direction that was seen answers";
}

TEST(Gallery, ViewsAreMeansByDirection) {
  Gallery gallery;
  EXPECT_TRUE(gallery.Views().empty());
  gallery.Add({1, 0}, 0.1);
  gallery.Add({0, 1}, 0.2);
  gallery.Add({0.6f, 0.8f}, -3.);
  const std::vector<AppearanceView> views = gallery.Views();
  ASSERT_EQ(views.size(), 2u);
  EXPECT_EQ(views[0].count, 1);
  EXPECT_NEAR(WrapAngle(views[0].viewpoint_rad + 3.), 0, M_PI / 8);
  EXPECT_EQ(views[1].count, 2);
  EXPECT_NEAR(views[1].viewpoint_rad, 0.1, M_PI / 8);
  EXPECT_EQ(views[1].vector, (std::vector<float>{0.5f, 0.5f}))
      << "its dot products are means of dot products";
}

TEST(Gallery, MergeTurnsViewpoints) {
  Gallery a, b;
  b.Add({0, 1}, 0.1);
  a.Add({1, 0}, 0.1);
  a.Merge(b, M_PI);
  EXPECT_NEAR(*a.Compare({0, 1}, 0.1 + M_PI), 1., 1e-6);
  EXPECT_NEAR(*a.Compare({1, 0}, 0.1), 1., 1e-6);
}

TEST(Gallery, EmptyNegativeAndOfAnotherLength) {
  Gallery gallery;
  EXPECT_FALSE(gallery.Compare({1, 0}, 0));
  gallery.Add({}, 0);
  EXPECT_FALSE(gallery.Compare({1, 0}, 0));
  gallery.Add({1, 0}, 0);
  EXPECT_FALSE(gallery.Compare({}, 0));
  EXPECT_FALSE(gallery.Compare({1, 0, 0}, 0));
  EXPECT_EQ(*gallery.Compare({-1, 0}, 0), 0.);
}

}  // namespace
}  // namespace sslcd
