// SPDX-License-Identifier: BSD-3-Clause
#include "sim/appearance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sslcd/core/error.h"

namespace sslcd::sim {
namespace {

double Dot(const std::vector<float>& a, const std::vector<float>& b) {
  EXPECT_EQ(a.size(), b.size());
  double sum = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) sum += double(a[i]) * b[i];
  return sum;
}

/// A car 15 m ahead in frame 0, seen by a camera that has driven round it in frame 1; `label` looks
/// alike from all sides if it is a pole.
struct Scene {
  World world;
  SimulatedDetections detections;
  explicit Scene(const std::string& label) {
    const Pose T_world_object(GravityFrame().Upright(0.2), Vec3(0, 0, 15));
    world.labels.Set("Car", {Symmetry::kNone});
    world.labels.Set("Pole", {Symmetry::kFull});
    WorldObject object;
    object.label = label;
    object.dims = Vec3(4, 2, 1.5);
    object.T_world_object = {T_world_object};
    object.paint = Vec3(0.6, 0.08, 0.08);
    world.objects = {object};
    world.truth.stamps = {0, 1};
    world.truth.poses = {Pose(), Pose(lie::SO3<double>::RotY(M_PI), Vec3(0, 0, 30))};
    for (int frame : {0, 1}) {
      Detection detection;
      detection.row = frame;
      detection.T_cam_object = world.truth.poses[frame].inverse() * T_world_object;
      detections.frames.push_back({detection});
      detections.identity.push_back(0);
    }
  }
  const Detection& At(int frame) const { return detections.frames[frame][0]; }
};

double MeanCosine(const std::string& label) {
  double sum = 0;
  constexpr int kSeeds = 400;
  for (int seed = 0; seed < kSeeds; ++seed) {
    Scene scene(label);
    AddAppearance(scene.world, {}, seed, scene.detections);
    sum += Dot(scene.At(0).appearance[Cue::kEmbedding], scene.At(1).appearance[Cue::kEmbedding]) /
           kSeeds;
  }
  return sum;
}

TEST(AddAppearance, OppositeSidesOfACarLookDifferentThoseOfAPoleDoNot) {
  EXPECT_NEAR(MeanCosine("Car"), 0.45, 0.04);
  EXPECT_NEAR(MeanCosine("Pole"), 0.75, 0.04);
}

TEST(AddAppearance, VectorsAreOfUnitLengthAndDeterministic) {
  Scene a("Car"), b("Car"), c("Car");
  // false positives look like something, too
  a.detections.identity[1] = b.detections.identity[1] = -1;
  AddAppearance(a.world, {}, 3, a.detections);
  AddAppearance(b.world, {}, 3, b.detections);
  AddAppearance(c.world, {}, 4, c.detections);
  for (int frame : {0, 1}) {
    EXPECT_NEAR(
        Dot(a.At(frame).appearance[Cue::kEmbedding], a.At(frame).appearance[Cue::kEmbedding]), 1,
        1e-5);
    EXPECT_NEAR(Dot(a.At(frame).appearance[Cue::kColour], a.At(frame).appearance[Cue::kColour]), 1,
                1e-5);
    EXPECT_EQ(a.At(frame).appearance[Cue::kEmbedding], b.At(frame).appearance[Cue::kEmbedding]);
    EXPECT_EQ(a.At(frame).appearance[Cue::kColour], b.At(frame).appearance[Cue::kColour]);
  }
  EXPECT_NE(a.At(0).appearance[Cue::kEmbedding], c.At(0).appearance[Cue::kEmbedding]);
}

TEST(AddAppearance, ColourIsThatOfThePaint) {
  Scene red("Car"), blue("Car");
  blue.world.objects[0].paint = Vec3(0.1, 0.2, 0.6);
  AddAppearance(red.world, {}, 1, red.detections);
  AddAppearance(blue.world, {}, 2, blue.detections);
  EXPECT_GT(Dot(red.At(0).appearance[Cue::kColour], red.At(1).appearance[Cue::kColour]), 0.9);
  EXPECT_LT(Dot(red.At(0).appearance[Cue::kColour], blue.At(0).appearance[Cue::kColour]),
            Dot(red.At(0).appearance[Cue::kColour], red.At(1).appearance[Cue::kColour]) - 0.1);
}

TEST(DrawPaint, HalfOfAllCarsAreWhiteGreyOrBlack) {
  Random random(1);
  int dull = 0;
  constexpr int kCars = 20000;
  for (int i = 0; i < kCars; ++i) {
    const Vec3 rgb = DrawPaint(random);
    EXPECT_TRUE((rgb.array() >= 0).all() && (rgb.array() <= 1).all());
    const bool silver = rgb.mean() > 0.55 && rgb.mean() < 0.81;
    dull += rgb.maxCoeff() - rgb.minCoeff() < 0.3 * rgb.maxCoeff() + 0.05 && !silver;
  }
  EXPECT_NEAR(static_cast<double>(dull) / kCars, 0.5, 0.06);
}

TEST(AddAppearance, BadOptions) {
  Scene scene("Car");
  EXPECT_THROW(AddAppearance(scene.world, {1}, 1, scene.detections), Error);
  AppearanceNoise noise;
  noise.other_object = 0.7;
  EXPECT_THROW(AddAppearance(scene.world, noise, 1, scene.detections), Error);
}

}  // namespace
}  // namespace sslcd::sim
