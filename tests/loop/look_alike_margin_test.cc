// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "track_attempts.h"

namespace sslcd {
namespace {

// One track, found with this prior, where a place outside of the map looks like one in it with the
// probability `look_alike`.
struct Alone {
  PoseTrack track;
  double margin = 0;

  Alone(const PosePrior& prior, double look_alike, int objects = 60) {
    PoseTrackOptions options;
    options.max_tracks = 1;
    options.look_alike = look_alike;
    Attempts attempts(Strewn(objects, 80, 1), options);
    attempts.Update(attempts.SeenAt(10, 5), 100,
                    [&](const YawShift&, const LayoutFit&) { return prior; });
    EXPECT_EQ(attempts.tracks.tracks().size(), 1u);
    track = attempts.tracks.tracks()[0];
    margin = attempts.tracks.Margin(0);
  }
  double layout() const { return track.evidence - track.prior.level - track.prior.height; }
};

TEST(PoseTracks, AloneTheyCompeteWithChanceWhereNothingLooksAlike) {
  const Alone alone({}, 1e-300);
  EXPECT_NEAR(alone.margin, alone.track.evidence, 1e-9);
}

TEST(PoseTracks, ObjectsAloneGiveNoMoreOddsThanAPlaceThatLooksAlike) {
  for (const double look_alike : {1e-2, 1e-4}) {
    const Alone alone({}, look_alike);
    ASSERT_GT(alone.track.evidence, -std::log(look_alike) + 5);
    EXPECT_NEAR(alone.margin, -std::log(look_alike), 0.01);
    const Alone more({}, look_alike, 120);
    ASSERT_GT(more.track.evidence, alone.track.evidence + 3);
    EXPECT_NEAR(more.margin, alone.margin, 0.01) << "more objects do not help";
    EXPECT_NEAR(Alone({3, 0}, look_alike).margin, alone.margin, 0.01)
        << "neither does odometry that has a look-alike there, too";
  }
}

TEST(PoseTracks, APoseThatOdometryExcludesIsNotSavedByItsObjects) {
  constexpr double kLookAlike = 1e-4;
  for (const double level : {-3., -10., -30.}) {
    const Alone alone({level, 0}, kLookAlike, 120);
    ASSERT_GT(alone.layout(), -std::log(kLookAlike) + 5);
    EXPECT_NEAR(alone.margin, -std::log(kLookAlike) + level, 0.01);
  }
}

TEST(PoseTracks, AHeightThatOdometryExcludesIsNotSavedByAGoodHorizontalFit) {
  constexpr double kLookAlike = 1e-4;
  for (const double level : {0., 5.}) {
    const Alone alone({level, -12}, kLookAlike, 120);
    ASSERT_GT(alone.layout(), -std::log(kLookAlike) + 5);
    EXPECT_NEAR(alone.margin, -std::log(kLookAlike) - 12, 0.01) << level;
  }
}

// The place itself, a copy with a fifth of the objects missing, and perhaps another copy, where
// odometry says that the camera cannot be.
TEST(PoseTracks, WhereTheMapRepeatsItselfOdometryAloneTellsCopiesApart) {
  std::vector<LayoutObject> map = Strewn(20, 40, 4);
  for (int i = 0; i < 16; ++i)
    map.push_back(ObjectAt(map[i].position + Vec3(300, 0, 0), map[i].label));
  std::vector<LayoutObject> repeated = map;
  for (int i = 0; i < 20; ++i)
    repeated.push_back(ObjectAt(map[i].position + Vec3(600, 0, 0), map[i].label));
  const auto margin = [](const std::vector<LayoutObject>& objects, double level_of_copy) {
    Attempts attempts(objects);
    attempts.Update(attempts.SeenAt(0, 0, 25), 100, [=](const YawShift& pose, const LayoutFit&) {
      return PosePrior{pose.t.x() > 450 ? -20. : pose.t.x() > 150 ? level_of_copy : 0., 0};
    });
    EXPECT_LT(attempts.tracks.tracks().at(0).pose.t.x(), 150);
    return attempts.tracks.Margin(0);
  };
  EXPECT_GT(margin(map, -1), 5) << "four objects more";
  EXPECT_NEAR(margin(repeated, -1), 1, 0.2) << "objects prove nothing";
  EXPECT_NEAR(margin(repeated, -6), 6, 0.3);
}

TEST(PoseTracks, TheLeadIsOverChanceAndTheOthers) {
  Attempts one(Strewn(60, 80, 1));
  one.Update(one.SeenAt(10, 5), 100);
  ASSERT_FALSE(one.tracks.tracks().empty());
  const double evidence = one.tracks.tracks()[0].evidence;
  EXPECT_GT(evidence, 8) << "above the limit of Margin()";
  EXPECT_NEAR(one.tracks.Lead(), evidence, 1e-3);
  std::vector<LayoutObject> map = Strewn(20, 40, 4);
  for (int i = 0; i < 20; ++i)
    map.push_back(ObjectAt(map[i].position + Vec3(300, 0, 0), map[i].label));
  Attempts twins(map);
  twins.Update(twins.SeenAt(0, 0, 25), 100);
  EXPECT_NEAR(twins.tracks.Lead(), 0, 0.1);
}

}  // namespace
}  // namespace sslcd
