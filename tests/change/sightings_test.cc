// SPDX-License-Identifier: BSD-3-Clause
#include "change/sightings.h"

#include <gtest/gtest.h>

#include <limits>

namespace sslcd {
namespace {

TEST(Sightings, LeaveOutDetectionsThatAreNotFinite) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  Detection sound;
  sound.T_cam_object = Pose::Trans(0, 0, 10);
  sound.dims = Vec3(4, 2, 1.5);
  Detection far = sound, flat = sound;
  far.T_cam_object.translation().x() = std::numeric_limits<double>::infinity();
  flat.dims.y() = kNaN;
  HistoryWorld world;
  world.sessions = 1;
  Sightings sightings(world);
  sightings.AddFrame({0, 0, 0, 0., Pose(), {far, sound, flat}});
  ASSERT_EQ(sightings.frames().size(), 1u);
  EXPECT_EQ(sightings.frames()[0].passing.size(), 1u);
}

}  // namespace
}  // namespace sslcd
