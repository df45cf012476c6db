// SPDX-License-Identifier: BSD-3-Clause
#include "retrieval/site_fit.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "random_sites.h"

namespace sslcd {
namespace {

struct Case {
  std::vector<SitePoint> stretch, site;
};

// A stretch around (75, 75) of a site, turned by -0.3, smaller by 2 %.
Case MakeCase() {
  Case one;
  for (const SiteObject& object : RandomSite("", 9, 300).objects) {
    const auto label = static_cast<std::uint16_t>(object.label == "Car");
    one.site.push_back({static_cast<float>(object.x), static_cast<float>(object.y), label, 0});
    const double x = (object.x - 75) / 1.02, y = (object.y - 75) / 1.02;
    if (std::hypot(x, y) > 35) continue;
    one.stretch.push_back({static_cast<float>(std::cos(-0.3) * x - std::sin(-0.3) * y),
                           static_cast<float>(std::sin(-0.3) * x + std::cos(-0.3) * y), label, 0});
  }
  std::sort(one.site.begin(), one.site.end(),
            [](const SitePoint& a, const SitePoint& b) { return a.x < b.x; });
  return one;
}

SiteFit Fit(const Case& one, const FlatPose& start) {
  return FitSite(one.stretch, {one.site.data(), one.site.data() + one.site.size()}, start);
}

TEST(SiteFit, AlignsFromACoarsePose) {
  const Case one = MakeCase();
  const SiteFit fit = Fit(one, {0.34f, 76.5f, 74});
  EXPECT_NEAR(fit.pose.yaw, 0.3, 0.01);
  EXPECT_NEAR(fit.pose.x, 75, 0.1);
  EXPECT_NEAR(fit.pose.y, 75, 0.1);
  EXPECT_EQ(fit.matches, static_cast<int>(one.stretch.size()));
  EXPECT_GT(fit.score, one.stretch.size());
}

// Further than the grid of the fit: one false object must not blind it to all others.
TEST(SiteFit, AFarObjectChangesLittle) {
  Case one = MakeCase();
  const SiteFit right = Fit(one, {0.34f, 76.5f, 74});
  for (const float far : {900.f, 5000.f, 1e30f}) {
    Case with = one;
    with.stretch.push_back({far, far / 2, 1, 0});
    const SiteFit fit = Fit(with, {0.34f, 76.5f, 74});
    EXPECT_EQ(fit.matches, right.matches) << far;
    EXPECT_NEAR(fit.pose.x, right.pose.x, 0.01) << far;
    EXPECT_NEAR(fit.score, right.score, 0.3f * right.score) << far;
  }
}

TEST(SiteFit, ScoresElsewhereLess) {
  const Case one = MakeCase();
  const float right = Fit(one, {0.3f, 75, 75}).score;
  EXPECT_LT(Fit(one, {2.f, 75, 75}).score, right / 3);
  EXPECT_LT(Fit(one, {0.3f, 50, 90}).score, right / 3);
  EXPECT_LT(Fit(one, {0.3f, 5000, 5000}).score, 0);
  Case dense = one;  // an object of the site that should be seen, and is not
  dense.site.insert(dense.site.begin(), {75, 75, 1, 0});
  std::sort(dense.site.begin(), dense.site.end(),
            [](const SitePoint& a, const SitePoint& b) { return a.x < b.x; });
  EXPECT_LT(Fit(dense, {0.3f, 75, 75}).score, right);
  Case other = one;
  for (SitePoint& point : other.stretch) point.label = 1 - point.label;
  EXPECT_LT(Fit(other, {0.3f, 75, 75}).score, right / 3);
}

// Each object that both have counts with the density of a match against that of its label; those
// that only one of them has count against the site.
TEST(SiteFit, ScoreAsItsEquation) {
  std::vector<SitePoint> site;
  for (int i = 0; i < 6; ++i)  // 6 m apart, each in a cell of its own
    site.push_back({6.f * static_cast<float>(i), 5.f * static_cast<float>(i % 2), 1, 0});
  std::vector<SitePoint> stretch(site.begin(), site.end() - 1);
  const auto score = [&] {
    return FitSite(stretch, {site.data(), site.data() + site.size()}, {}).score;
  };
  const double match = std::log(0.75 / (2 * M_PI * 0.7 * 0.7)), missed = std::log(0.25);
  const auto chance = [](int count, int cells) {
    return std::log((count + 0.5) / (4 * 4 * 3 * cells));
  };
  EXPECT_NEAR(score(), 5 * (match - chance(6, 6)), 1e-3);
  stretch.push_back({0, 100, 1, 0});  // far from all of the site
  EXPECT_NEAR(score(), 5 * (match - chance(6, 6)) + missed, 1e-3);
  // of another label, amid the stretch, in the cell of its neighbour
  site.insert(site.end() - 1, {25, 2, 2, 0});
  EXPECT_NEAR(score(), 5 * (match - chance(6, 6)) + missed - 0.7, 1e-3);
}

TEST(SiteFit, DegenerateInput) {
  const Case one = MakeCase();
  EXPECT_EQ(FitSite({}, {one.site.data(), one.site.data() + 3}, {}).matches, 0);
  EXPECT_EQ(FitSite(one.stretch, {}, {}).matches, 0);
  EXPECT_EQ(Fit(one, {NAN, NAN, NAN}).matches, 0);
}

}  // namespace
}  // namespace sslcd
