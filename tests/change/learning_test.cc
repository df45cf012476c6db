// SPDX-License-Identifier: BSD-3-Clause
#include "change/learning.h"

#include <gtest/gtest.h>

namespace sslcd {
namespace {

enum What { kNothing, kObject, kUnseen };

// The look of one session against the one before, from the same side.
LookPair LookOf(double cosine, bool reversed) {
  LookPair look;
  look.cues[Cue::kEmbedding] = LookPair::Similarity{cosine, 0};
  look.reversed = reversed;
  look.sightings = 10;
  return look;
}

// Places by what each session has found at each of them, beyond doubt. What is there again looks as
// before.
struct Drives {
  std::vector<Place> places;
  std::vector<PlaceRecord> records;

  void Add(int count, const std::string& label, const std::vector<What>& found) {
    Place place;
    place.label = label;
    PlaceRecord record;
    for (const What what : found) {
      Visit visit;
      visit.there.fill(what == kNothing ? -100 : 0);
      visit.empty.fill(what == kObject ? -100 : 0);
      record.visits.push_back({visit});
      if (what == kUnseen) record.visits.back().clear();
      const bool again = what == kObject && !place.sessions.empty();
      record.looks.push_back(again ? LookOf(0.75, false) : LookPair());
      place.sessions.emplace_back();
      place.sessions.back().sightings = what == kObject ? 10 : 0;
    }
    for (int i = 0; i < count; ++i) {
      places.push_back(place);
      records.push_back(record);
    }
  }
};

TEST(LearnChanges, RatesAreSharesOfThePlaces) {
  Drives drives;
  drives.Add(140, "Car", {kObject, kObject});
  drives.Add(60, "Car", {kObject, kNothing});
  drives.Add(90, "Car", {kNothing, kNothing});
  drives.Add(10, "Car", {kNothing, kObject});
  const Learnt learnt = LearnChanges(drives.places, drives.records);
  EXPECT_NEAR(learnt.rates.at("Car").departure, 0.3, 0.02);
  EXPECT_NEAR(learnt.rates.at("Car").arrival, 0.1, 0.02);
  EXPECT_NEAR(learnt.first, 200. / 300, 0.01);
  EXPECT_LT(drives.records[0].chain.states[1][kEmpty], 1e-6);
  EXPECT_GT(drives.records[140].chain.states[1][kEmpty], 1 - 1e-6);
}

TEST(LearnChanges, ALabelWithFewPlacesIsLikeAllLabels) {
  Drives drives;
  drives.Add(150, "Car", {kObject, kObject});
  drives.Add(50, "Car", {kObject, kNothing});
  drives.Add(1, "Van", {kObject, kObject});
  drives.Add(100, "Pole", {kObject, kObject});
  const auto rates = LearnChanges(drives.places, drives.records).rates;
  EXPECT_NEAR(rates.at("Car").departure, 0.25, 0.01);
  EXPECT_LT(rates.at("Pole").departure, 0.01);
  const double all = 51. / 306;  // with one of five that changes
  EXPECT_NEAR(rates.at("Van").departure, 4 * all / 5, 0.01);
}

TEST(LearnChanges, LooksAreThoseOfSessionsWithSightings) {
  Drives drives;
  drives.Add(1, "Car", {kObject, kUnseen, kObject});
  LearnChanges(drives.places, drives.records);
  const PlaceRecord& record = drives.records[0];
  EXPECT_TRUE(record.sessions[0].looks);
  EXPECT_FALSE(record.sessions[1].looks);
  EXPECT_EQ(record.sessions[1].log_there, record.sessions[1].log_empty) << "not in view";
}

TEST(LearnChanges, WhatStaysShowsHowOneObjectLooks) {
  const LookStatistics prior = LookStatistics::Prior();
  const LearntNormal& before = prior.same.sides[Cue::kEmbedding][0];
  Drives drives;
  drives.Add(30, "Car", {kObject, kObject, kNothing});
  for (PlaceRecord& record : drives.records) record.looks[1] = LookOf(0.85, false);
  const LookStatistics looks = LearnChanges(drives.places, drives.records).looks;
  const LearntNormal& after = looks.same.sides[Cue::kEmbedding][0];
  EXPECT_NEAR(after.weight, before.weight + 30, 0.5);
  EXPECT_NEAR(after.Mean(), (before.sum + 30 * 0.85) / (before.weight + 30), 0.01);
  EXPECT_NEAR(looks.same.not_reversed, prior.same.not_reversed + 30, 0.5);
  EXPECT_EQ(looks.same.reversed, prior.same.reversed);
  EXPECT_NEAR(looks.other.not_reversed, prior.other.not_reversed, 0.5);
}

TEST(LearnChanges, WhatWasReplacedShowsHowOtherObjectsAreTurned) {
  const LookStatistics prior = LookStatistics::Prior();
  Drives drives;
  drives.Add(30, "Car", {kObject, kObject});
  for (PlaceRecord& record : drives.records) record.looks[1] = LookOf(0.2, true);
  const Learnt learnt = LearnChanges(drives.places, drives.records);
  EXPECT_GT(learnt.rates.at("Car").replaced, 0.9);
  EXPECT_GT(learnt.rates.at("Car").departure, 0.8);
  EXPECT_NEAR(learnt.looks.other.reversed, prior.other.reversed + 30, 1);
  EXPECT_NEAR(learnt.looks.same.reversed, prior.same.reversed, 1);
}

TEST(LearnChanges, DifferentPlacesOfALabelShowHowOtherObjectsLook) {
  Drives drives;
  drives.Add(10, "Car", {kObject, kObject});
  for (std::size_t i = 0; i < drives.places.size(); ++i)
    for (SessionLooks& session : drives.places[i].sessions)
      for (int k = 0; k < 10; ++k) session.views[Cue::kEmbedding].Add({0.6f, 0.8f}, 0);
  const LookStatistics looks = LearnChanges(drives.places, drives.records).looks;
  const LearntNormal before = LookStatistics::Prior().other.sides[Cue::kEmbedding][0];
  const LearntNormal& after = looks.other.sides[Cue::kEmbedding][0];
  EXPECT_NEAR(after.weight, before.weight + 50, 1e-9) << "each with five others";
  EXPECT_NEAR(after.Mean(), (before.sum + 50) / (before.weight + 50), 1e-6);
}

TEST(LearnChanges, NoPlaces) {
  std::vector<PlaceRecord> records;
  const Learnt learnt = LearnChanges({}, records);
  EXPECT_TRUE(learnt.rates.empty());
  EXPECT_EQ(learnt.first, 0.5);
  // the prior: how visits are where an object is, and where none is
  const VisitKinds kinds{{0.05, 0.05, 0.1, 0.4, 0.4}, {8 / 9.5, 1 / 9.5, 0.5 / 9.5}};
  for (std::size_t i = 0; i < kinds.there.size(); ++i)
    EXPECT_NEAR(learnt.kinds.there[i], kinds.there[i], 1e-12) << i;
  for (std::size_t i = 0; i < kinds.empty.size(); ++i)
    EXPECT_NEAR(learnt.kinds.empty[i], kinds.empty[i], 1e-12) << i;
}

}  // namespace
}  // namespace sslcd
