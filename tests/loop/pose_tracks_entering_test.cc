// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "loop/pose_tracks.h"
#include "track_attempts.h"

namespace sslcd {
namespace {

// In the first attempt all objects but four are not in the map.
TEST(PoseTracks, WithoutOdometryTheCameraMayEnterTheMapOnTheWay) {
  const auto track = [](bool joins) {
    Attempts attempts(Strewn(60, 80, 1));
    auto first = attempts.SeenAt(14, 0, 25);
    for (std::size_t i = 4; i < first.size(); ++i)
      first[i].position += Vec3(i % 2 ? 3 : -4, i % 3 ? 3 : -4, 0);
    const auto prior = [joins](const YawShift&, const LayoutFit&) {
      return PosePrior{0, 0, joins};
    };
    attempts.Update(first, 100, prior);
    attempts.Update(attempts.SeenAt(18, 0, 25), 105, prior);
    return attempts.tracks.tracks().at(0);
  };
  const PoseTrack joining = track(true), other = track(false);
  ASSERT_EQ(joining.votes.size(), 2u);
  ASSERT_EQ(other.votes.size(), 2u);
  EXPECT_NEAR(joining.evidence, joining.fit.evidence - std::log(2.), 1e-9);
  EXPECT_LT(other.evidence, joining.evidence - 1);
}

}  // namespace
}  // namespace sslcd
