// SPDX-License-Identifier: BSD-3-Clause
#include "change/evidence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

namespace sslcd {
namespace {

constexpr VisitKinds kKinds = {{0.05, 0.05, 0.1, 0.4, 0.4}, {0.85, 0.1, 0.05}};

// Views one per second, of an object ahead that nothing hides.
Views MakeViews(const std::string& seen, double start = 0, float range = 10) {
  Views views;
  for (std::size_t i = 0; i < seen.size(); ++i)
    views.push_back({start + static_cast<double>(i), range, 0, 1, seen[i] == 's'});
  return views;
}

Place Car() {
  Place place;
  place.label = "Car";
  return place;
}

// Learnt from objects that are seen in four views of five.
DetectionRate UsualRate() {
  std::vector<Place> places(20, Car());
  return DetectionRate(places, std::vector<std::vector<Views>>(20, {MakeViews("ssss.ssss.")}));
}

double LogOdds(const Views& views) {
  const std::vector<Visit> visits = VisitsOf(views, "Car", UsualRate());
  return LogThere(visits, kKinds) - LogEmpty(visits, kKinds);
}

TEST(DetectionRate, IsThatOfObjectsThatAreSeen) {
  EXPECT_NEAR(UsualRate().At(MakeViews("s")[0], "Car"), 0.8, 0.05);
}

TEST(DetectionRate, ASingleSightingTeachesNothing) {
  std::vector<Place> places(20, Car());
  const DetectionRate rate(places, std::vector<std::vector<Views>>(20, {MakeViews("s.........")}));
  EXPECT_EQ(rate.At(MakeViews("s")[0], "Car"), 0.5);
}

TEST(DetectionRate, DependsOnRangeAndBearingAndWhatIsHidden) {
  Views views;
  for (int i = 0; i < 600; ++i) {
    View view;
    view.stamp = i;
    view.range_m = i % 2 == 0 ? 5.f : 50.f;
    view.bearing_rad = i % 3 == 0 ? 1.5f : 0.f;
    view.visible = i % 5 == 0 ? 0.1f : 1.f;
    view.seen = view.range_m < 10 && view.bearing_rad < 1 && view.visible > 0.5;
    views.push_back(view);
  }
  const DetectionRate rate({Car()}, {{views}});
  EXPECT_GT(rate.At({0, 5, 0, 1, false}, "Car"), 0.8);
  EXPECT_LT(rate.At({0, 50, 0, 1, false}, "Car"), 0.2);
  EXPECT_LT(rate.At({0, 5, 1.5, 1, false}, "Car"), 0.2);
  EXPECT_LT(rate.At({0, 5, 0, 0.1, false}, "Car"), 0.2);
}

TEST(DetectionRate, IsThatOfRangesWithinATenthOfTheLongest) {
  Views views;
  for (int i = 0; i < 200; ++i) {
    const float range_m = i % 2 == 0 ? 6.f : 50.f;
    views.push_back({static_cast<double>(i), range_m, 0, 1, range_m < 10});
  }
  const DetectionRate rate({Car()}, {{views}});
  const auto at = [&](float range_m) { return rate.At({0, range_m, 0, 1, false}, "Car"); };
  EXPECT_GT(at(6), 0.9);
  EXPECT_EQ(at(9.9f), at(6));
  EXPECT_EQ(at(5.1f), at(6));
  EXPECT_NEAR(at(10.1f), 0.5, 0.05) << "of all ranges";
  EXPECT_NEAR(at(4.9f), 0.5, 0.05);
}

TEST(DetectionRate, AtNoDistanceOrNoneThatIsANumber) {
  for (const float range_m : {0.f, std::numeric_limits<float>::infinity(), std::nanf("")}) {
    const Views views(10, View{0, range_m, range_m, 1, true});
    const double rate = DetectionRate({Car()}, {{views}}).At(views[0], "Car");
    EXPECT_GT(rate, 0.5) << range_m;
  }
}

TEST(Evidence, SightingsSpeakForAndMissesAgainst) {
  EXPECT_GT(LogOdds(MakeViews("s.ssss.s")), 8);
  EXPECT_LT(LogOdds(MakeViews("........")), -2);
  EXPECT_EQ(LogOdds({}), 0);
  EXPECT_GT(LogOdds(MakeViews("...")), LogOdds(MakeViews("......")));
}

TEST(Evidence, AVisitMayOverlookAnObject) {
  // a second visit says more than more views in the first one
  Views twice = MakeViews("........");
  const Views again = MakeViews("........", 100);
  twice.insert(twice.end(), again.begin(), again.end());
  EXPECT_LT(LogOdds(twice), LogOdds(MakeViews("................")) - 1);
  EXPECT_EQ(VisitsOf(twice, "Car", UsualRate()).size(), 2u);
}

TEST(Evidence, OneOfManyIsAFalseSighting) { EXPECT_LT(LogOdds(MakeViews("....s...........")), 0); }

TEST(Evidence, CountsWhatIsExpected) {
  const std::vector<Visit> visits = VisitsOf(MakeViews("s.s.s.s.s."), "Car", UsualRate());
  ASSERT_EQ(visits.size(), 1u);
  EXPECT_EQ(visits[0].seen, 5);
  EXPECT_EQ(visits[0].views, 10);
  EXPECT_NEAR(visits[0].expected, 8, 0.5);
}

TEST(Evidence, CountsKinds) {
  VisitKinds counts;
  const Visit visit = VisitsOf(MakeViews("ssssssss"), "Car", UsualRate())[0];
  Count(visit, kKinds, 0.75, 0.25, counts);
  EXPECT_NEAR(std::accumulate(counts.there.begin(), counts.there.end(), 0.), 0.75, 1e-9);
  EXPECT_NEAR(std::accumulate(counts.empty.begin(), counts.empty.end(), 0.), 0.25, 1e-9);
  EXPECT_GT(counts.there[4], 0.5);
}

}  // namespace
}  // namespace sslcd
