// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "sslcd/pipeline/localiser.h"
#include "sslcd/pipeline/options.h"
#include "store_drive.h"

namespace sslcd {
namespace {

TEST(ReferenceMap, HasTheConfirmedLandmarks) {
  const TempFolder folder;
  const StoreDrive drive = ShortStreet();
  const MapStore store(MakeMap(folder, drive));
  const ReferenceMap map = store.Reference();
  const MapResults results = store.Results();
  EXPECT_EQ(map.gravity.up, drive.world.gravity.up);
  EXPECT_EQ(map.scale, results.scale);
  const Eigen::Matrix3d basis = map.gravity.Basis();
  const double floor = drive.world.camera_height_m;
  std::size_t at = 0;
  for (const MapObject& landmark : results.objects) {
    if (landmark.state != LandmarkState::kConfirmed) continue;
    ASSERT_LT(at, map.objects.size());
    const LayoutObject& object = map.objects[at++];
    EXPECT_EQ(object.id, landmark.id.value);
    EXPECT_EQ(map.label_names.at(static_cast<std::size_t>(object.label)), landmark.label);
    EXPECT_EQ(object.symmetry, drive.world.labels[landmark.label].symmetry);
    EXPECT_EQ(object.dims, landmark.dims);
    const Vec3 place(object.position.x(), object.position.y(), object.altitude);
    EXPECT_LT((basis * place - landmark.T_world_object.translation()).norm(), 1e-9);
    EXPECT_NEAR(object.position.z(), 0.5 * landmark.dims.z() - floor, 0.4) << "above the cameras";
    EXPECT_EQ(std::isnan(object.yaw), object.symmetry == Symmetry::kFull);
    // all sightings look alike; one view for each side that was seen
    ASSERT_FALSE(object.appearance[Cue::kEmbedding].empty());
    int sightings = 0;
    for (const AppearanceView& view : object.appearance[Cue::kEmbedding]) {
      EXPECT_NEAR(view.vector.at(0), 0.6, 1e-6);
      sightings += view.count;
    }
    EXPECT_EQ(sightings, static_cast<int>(landmark.observations.size()));
    EXPECT_TRUE(object.appearance[Cue::kColour].empty());
  }
  EXPECT_EQ(at, map.objects.size());
  EXPECT_GT(at, 5u);
}

// The same street again, with other noise.
TEST(ReferenceMap, IsLocalisedIn) {
  const TempFolder folder;
  const MapStore store(MakeMap(folder, ShortStreet(60, 1)));
  const StoreDrive again(ShortStreet(60, 1).world, 2);
  Localiser localiser(store.Reference(), {}, again.world.camera);
  int found = 0;
  for (const Frame& frame : again.frames) {
    const auto answer = localiser.AddFrame(frame);
    if (!answer || answer->decision != LoopDecision::kAccepted) continue;
    ++found;
    const Pose& truth = again.world.truth.poses[static_cast<std::size_t>(frame.index)];
    EXPECT_LT((truth.inverse() * answer->T_map_cam).translation().norm(), 1) << frame.index;
  }
  EXPECT_GE(found, 2);
}

}  // namespace
}  // namespace sslcd
