// SPDX-License-Identifier: BSD-3-Clause
#include "map/association_inputs.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sslcd {
namespace {

// A landmark 20 m ahead of the first camera that drove 10 m/s to the right for two seconds.
MapLandmark Driving(LandmarkState state, const MotionTestOptions& motion) {
  MapLandmark landmark;
  landmark.state = state;
  landmark.pose.position = Vec3(19, 0, 20);
  for (int i = 0; i < 20; ++i)
    landmark.motion.Add({i, 20.}, 0.01 * Eigen::Matrix2d::Identity(), 0.1 * i, motion);
  return landmark;
}

TEST(AssociationInputs, ADetectionIsLeastCertainAlongItsRay) {
  Detection detection;
  detection.T_cam_object = Pose::Trans(0, 1, 20);
  const NoiseScale scale = NoiseScale::Uniform(1.);
  const AssociationQuery query =
      QueryOf(detection, Pose::Trans(5, 0, 0), GravityFrame(), DetectionNoise(), scale);
  EXPECT_EQ(query.detection, &detection);
  EXPECT_NEAR((query.place.position - Vec2(5, 20)).norm(), 0, 1e-12);
  EXPECT_NEAR(query.height, -1, 1e-12);
  const DetectionSigmas learnt = SigmasAt(std::hypot(1., 20.), DetectionNoise(), scale);
  EXPECT_GT(std::sqrt(query.place.covariance(1, 1)), kLongTailScale * learnt.radial)
      << "gates are wider than the noise";
  EXPECT_GT(query.place.covariance(1, 1), 2 * query.place.covariance(0, 0));
}

TEST(AssociationInputs, TheLikelierPlaceComesFirst) {
  const MotionTestOptions motion;
  FrameView view;
  view.stamp = 2.9;  // a second after the last sighting
  const auto predictions_of = [&](const MapLandmark& landmark) {
    return CandidateOf(landmark, view, GravityFrame(), motion).predictions;
  };
  const auto dynamic = predictions_of(Driving(LandmarkState::kDynamic, motion));
  ASSERT_EQ(dynamic.size(), 2u);
  EXPECT_NEAR(dynamic[0].position.x(), 29, 1);
  EXPECT_EQ(dynamic[1].position.x(), 19);
  MapLandmark landmark = Driving(LandmarkState::kTentative, motion);
  const auto tentative = predictions_of(landmark);
  ASSERT_EQ(tentative.size(), 2u);
  EXPECT_EQ(tentative[0].position.x(), 19);
  EXPECT_NEAR(tentative[1].position.x(), 29, 1);
  landmark.symmetry = Symmetry::kFull;
  EXPECT_EQ(predictions_of(landmark).size(), 1u) << "a tree does not drive";
}

TEST(AssociationInputs, OnlyACameraGivesABox) {
  MapLandmark landmark = Driving(LandmarkState::kConfirmed, {});
  landmark.pose.position = Vec3(0, 0, 20);
  landmark.dims = Vec3(4, 2, 1.5);
  FrameView view;
  EXPECT_FALSE(CandidateOf(landmark, view, GravityFrame(), {}).projected_box);
  Camera camera;
  camera.fx = camera.fy = 700;
  camera.cx = 600;
  camera.cy = 180;
  camera.width = 1200;
  camera.height = 360;
  view.camera = &camera;
  const auto box = CandidateOf(landmark, view, GravityFrame(), {}).projected_box;
  ASSERT_TRUE(box);
  EXPECT_LT(box->left, 600);
  EXPECT_GT(box->right, 600);
}

}  // namespace
}  // namespace sslcd
