// SPDX-License-Identifier: BSD-3-Clause
#include "change/places.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sslcd {
namespace {

// A landmark as one session has it.
struct Landmark {
  Vec3 at{0, 0, 0};  // [forward, left, up]; all face forward
  Vec3 dims{4, 2, 1.5};
  std::string label = "Car";
  LandmarkState state = LandmarkState::kConfirmed;
  int first = 0, count = 10;  // frames with a sighting
  double look = 0;            // direction of the embedding [rad]; NaN: none
  int map = 0;
};

// The camera looks to the left, from `range_m` before the origin.
std::vector<Place> Places(const std::vector<Landmark>& landmarks, double range_m = 10,
                          double noise = 1) {
  HistoryWorld world;
  world.sessions = 1;
  world.noise = NoiseScale::Uniform(noise);
  world.labels.Set("Pole", {Symmetry::kFull});
  std::vector<HistoryFrame> frames(60);
  for (std::size_t f = 0; f < frames.size(); ++f) {
    frames[f].number = static_cast<int>(f);
    frames[f].T_world_cam = Pose::Trans(0, 0, -range_m);
  }
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    const Landmark& one = landmarks[i];
    MapObject object;
    object.id.value = static_cast<int>(i) + 1;
    object.label = one.label;
    object.state = one.state;
    object.dims = one.dims;
    object.T_world_object = Pose(world.gravity.Upright(0), Vec3(world.gravity.Basis() * one.at));
    for (int f = one.first; f < one.first + one.count; ++f) {
      Detection detection;
      detection.row = static_cast<int>(i);
      detection.dims = one.dims;
      detection.T_cam_object = frames[f].T_world_cam.inverse() * object.T_world_object;
      if (std::isfinite(one.look))
        detection.appearance[Cue::kEmbedding] = {static_cast<float>(std::cos(one.look)),
                                                 static_cast<float>(std::sin(one.look))};
      frames[f].map = one.map;
      frames[f].detections.push_back(detection);
      object.observations.push_back({f, detection.row});
    }
    world.objects.push_back(object);
  }
  Sightings sightings(world);
  for (const HistoryFrame& frame : frames) sightings.AddFrame(frame);
  return FindPlaces(sightings);
}

// A landmark with these dimensions, and another one of a later time.
bool AreOnePlace(const Vec3& dims, const Vec3& apart, const char* label = "Car") {
  Landmark one, other;
  one.dims = other.dims = dims;
  one.label = other.label = label;
  one.look = other.look = std::nan("");  // nothing to compare
  other.at = apart;
  other.first = 20;
  return Places({one, other}).size() == 1;
}

TEST(Places, OverlapByHalf) {
  const Vec3 car(4, 2, 1.5);
  EXPECT_TRUE(AreOnePlace(car, {1.9, 0, 0}));
  EXPECT_FALSE(AreOnePlace(car, {2.1, 0, 0})) << "along";
  EXPECT_TRUE(AreOnePlace(car, {0, 0.95, 0}));
  EXPECT_FALSE(AreOnePlace(car, {0, 1.05, 0})) << "across";
  EXPECT_TRUE(AreOnePlace(car, {0, 0, 0.7}));
  EXPECT_FALSE(AreOnePlace(car, {0, 0, -0.8})) << "another storey";
  const Vec3 round(3, 1, 4);
  EXPECT_TRUE(AreOnePlace(round, {0, 1.4, 0}, "Pole")) << "of any heading";
  EXPECT_FALSE(AreOnePlace(round, {0, 1.6, 0}, "Pole"));
}

TEST(Places, SmallObjectsAreNearWithin60Centimetres) {
  const Vec3 pole(0.3, 0.3, 0.3);
  for (const Vec3& direction : {Vec3(1, 0, 0), Vec3(0, -1, 0), Vec3(0, 0, 1)}) {
    EXPECT_TRUE(AreOnePlace(pole, 0.55 * direction)) << direction.transpose();
    EXPECT_FALSE(AreOnePlace(pole, 0.65 * direction)) << direction.transpose();
  }
}

TEST(Places, HaveObjectsOfNearlyOneSize) {
  for (const double factor : {1.5, 1 / 1.5, 1.7, 1 / 1.7}) {
    Landmark one, other;
    other.first = 20;
    other.dims.z() *= factor;
    const bool same = std::abs(std::log(factor)) < std::log(1.6);
    EXPECT_EQ(Places({one, other}).size(), same ? 1u : 2u) << factor;
  }
}

TEST(Places, ObjectsThatWereSeenTogetherAreTwoButForASlip) {
  for (const int together : {1, 2}) {
    Landmark one, other;
    other.first = 10 - together;
    other.count = 30;
    EXPECT_EQ(Places({one, other}).size(), static_cast<std::size_t>(together)) << together;
  }
}

TEST(Places, WhatJoinsIsSeenTogetherWithBoth) {
  Landmark one, other, third;
  other.at.x() = 0.2;
  other.first = 20;
  third.at.x() = 0.5;  // nearer to `other`, seen with `one`
  EXPECT_EQ(Places({one, other, third}).size(), 2u);
  third.first = 40;
  const std::vector<Place> places = Places({one, other, third});
  ASSERT_EQ(places.size(), 1u);
  EXPECT_EQ(places[0].landmarks.size(), 3u);
  EXPECT_EQ(places[0].sessions[0].sightings, 30);
}

TEST(Places, FartherApartOnlyByNoiseOfObjectsThatLookAlike) {
  Landmark one, other;
  one.dims = other.dims = Vec3(0.3, 0.3, 0.3);
  other.first = 20;
  // At 40 m, with five times the default noise, two positions are 1.3 m apart along the ray and
  // .7 m across (one sigma).
  const auto apart = [&](const Vec3& at) {
    other.at = at;
    return Places({one, other}, 40, 5).size() == 2;
  };
  EXPECT_FALSE(apart({0, 3.5, 0}));
  EXPECT_TRUE(apart({0, 4.5, 0}));
  EXPECT_FALSE(apart({1.9, 0, 0}));
  EXPECT_TRUE(apart({2.5, 0, 0}));
  other.look = 1.5;
  EXPECT_TRUE(apart({0, 3.5, 0})) << "another look";
  other.look = 0;
  other.at = {0, 4.9, 0};
  EXPECT_EQ(Places({one, other}, 40, 20).size(), 1u);
  other.at = {0, 5.1, 0};
  EXPECT_EQ(Places({one, other}, 40, 20).size(), 2u) << "too far whatever the noise";
}

TEST(Places, OfOtherMapsAreOthers) {
  Landmark one, other;
  other.first = 20;
  other.map = 1;
  EXPECT_EQ(Places({one, other}).size(), 2u);
}

TEST(Places, HaveAConfirmedObjectThatStands) {
  Landmark tentative, confirmed, driving;
  tentative.state = LandmarkState::kTentative;
  tentative.count = 15;
  confirmed.first = 20;
  driving.state = LandmarkState::kDynamic;
  driving.first = 40;
  EXPECT_TRUE(Places({tentative}).empty());
  EXPECT_TRUE(Places({driving}).empty());
  const std::vector<Place> places = Places({tentative, driving, confirmed});
  ASSERT_EQ(places.size(), 1u);
  EXPECT_EQ(places[0].landmarks, (std::vector<int>{2, 0})) << "confirmed ones first";
  confirmed.count = 0;
  EXPECT_TRUE(Places({tentative, confirmed}).empty()) << "never seen";
}

TEST(Places, TheFirstLandmarkHasMostSightings) {
  Landmark few, many;
  few.label = "Van";
  many.first = 20;
  many.count = 11;
  const std::vector<Place> places = Places({few, many});
  ASSERT_EQ(places.size(), 1u);
  EXPECT_EQ(places[0].label, "Car");
  EXPECT_EQ(places[0].landmarks, (std::vector<int>{1, 0}));
}

}  // namespace
}  // namespace sslcd
