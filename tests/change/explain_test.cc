// SPDX-License-Identifier: BSD-3-Clause
#include "change/explain.h"

#include <gtest/gtest.h>

#include "parked_row.h"

namespace sslcd {
namespace {

// The number of the place at an object of a row.
int PlaceAt(const MapHistory& history, const RowObject& object) {
  int found = -1;
  for (std::size_t i = 0; i < history.places().size(); ++i) {
    const Vec3& p = history.places()[i].T_world_object.translation();
    if (std::hypot(p.x() - object.x, p.z() - object.z) < 1.5) {
      EXPECT_EQ(found, -1) << "two places";
      found = static_cast<int>(i);
    }
  }
  return found;
}

PlaceOutcome Outcome(const MapHistory& history, const RowObject& object, int from, int to) {
  const int place = PlaceAt(history, object);
  return place < 0 ? PlaceOutcome() : history.Between(place, from, to);
}

TEST(Explain, NothingChangesOnARowThatStands) {
  const ParkedRow row = StandingRow(3);
  const MapHistory history = row.History();
  EXPECT_EQ(history.places().size(), row.objects.size());
  for (std::size_t i = 0; i < history.places().size(); ++i)
    for (const int from : {0, 1})
      EXPECT_GT(history.Between(static_cast<int>(i), from, from + 1).stayed, 0.9) << i;
  EXPECT_LT(history.rates().at("Pole").departure, 0.1);
}

TEST(Explain, FindsDeparturesArrivalsAndReplacements) {
  ParkedRow row = StandingRow(3);
  row.objects[4].there = {5, 0, 0};
  row.objects[5].there = {0, 6, 6};
  row.objects[7].there = {8, 10, 10};
  row.objects[8].there = {9, 9, 0};
  const MapHistory history = row.History();
  EXPECT_GT(Outcome(history, row.objects[4], 0, 1).departed, 0.9);
  EXPECT_GT(Outcome(history, row.objects[4], 1, 2).empty, 0.8);
  EXPECT_GT(Outcome(history, row.objects[5], 0, 1).arrived, 0.7);
  EXPECT_GT(Outcome(history, row.objects[7], 0, 1).replaced, 0.8);
  EXPECT_GT(Outcome(history, row.objects[7], 1, 2).stayed, 0.9);
  EXPECT_GT(Outcome(history, row.objects[8], 0, 1).stayed, 0.9);
  EXPECT_GT(Outcome(history, row.objects[8], 0, 2).departed, 0.8);
  EXPECT_GT(Outcome(history, row.objects[3], 0, 2).stayed, 0.9);
  // by label: cars come and go, poles do not
  EXPECT_GT(history.rates().at("Car").departure, 2 * history.rates().at("Pole").departure);
  const PlaceHistory& left = history.places()[PlaceAt(history, row.objects[4])];
  EXPECT_EQ(left.label, "Car");
  EXPECT_GT(left.sessions[0].seen, 5);
  EXPECT_EQ(left.sessions[1].seen, 0);
  EXPECT_GT(left.sessions[1].expected, 5);
  EXPECT_GT(left.sessions[0].probability, 0.99);
  EXPECT_LT(left.sessions[2].probability, 0.1);
}

TEST(Explain, ASessionThatTurnsBackSaysNothingOfTheRest) {
  ParkedRow row = StandingRow(2);
  row.length_m[1] = 30;
  const MapHistory history = row.History();
  const PlaceHistory& far = history.places()[PlaceAt(history, row.objects[10])];
  EXPECT_FALSE(far.sessions[1].InView());
  EXPECT_EQ(far.sessions[1].expected, 0);
  EXPECT_TRUE(history.places()[PlaceAt(history, row.objects[2])].sessions[1].InView());
}

TEST(Explain, WhatIsHiddenIsNotMissed) {
  ParkedRow row = StandingRow(2);
  // a car in a second row, and a lorry before it in the second session
  row.objects.push_back({"Car", 12, 34, {30, 30}});
  row.objects.push_back({"Truck", 8, 27, {0, 31}, {12, 3, 3}});
  const MapHistory history = row.History();
  const PlaceHistory& hidden = history.places()[PlaceAt(history, row.objects[12])];
  ASSERT_GT(hidden.sessions[0].seen, 5);
  EXPECT_LT(hidden.sessions[1].expected, 0.4 * hidden.sessions[0].expected);
  EXPECT_LT(Outcome(history, row.objects[12], 0, 1).Departure(), 0.5);
}

TEST(Explain, SessionsWithoutACommonMapSayNothingOfEachOther) {
  ParkedRow row = StandingRow(2);
  row.map[1] = 1;
  row.own_landmarks = true;
  const MapHistory history = row.History();
  ASSERT_EQ(history.places().size(), 2 * row.objects.size());
  for (const PlaceHistory& place : history.places())
    EXPECT_FALSE(place.sessions[0].InView() && place.sessions[1].InView());
}

TEST(Explain, LandmarksOfTwoSessionsAreOnePlace) {
  ParkedRow row = StandingRow(2);
  row.own_landmarks = true;
  row.objects[4].there = {5, 0};
  const MapHistory history = row.History();
  EXPECT_EQ(history.places().size(), row.objects.size());
  EXPECT_EQ(history.places()[PlaceAt(history, row.objects[3])].landmarks.size(), 2u);
  EXPECT_GT(Outcome(history, row.objects[3], 0, 1).stayed, 0.9);
  EXPECT_GT(Outcome(history, row.objects[4], 0, 1).departed, 0.8);
}

TEST(Explain, ObjectsSeenTogetherAreTwoPlaces) {
  ParkedRow row = StandingRow(2);
  RowObject second = row.objects[0];
  second.x -= 0.5;
  row.objects.push_back(second);
  EXPECT_EQ(row.History().places().size(), row.objects.size());
}

TEST(Explain, DegenerateMaps) {
  EXPECT_TRUE(ParkedRow().History().places().empty());
  ParkedRow one;
  one.sessions = 1;
  one.objects = {{"Car", 5, 20, {1}}};
  EXPECT_EQ(one.History().places().size(), 1u);
  EXPECT_TRUE(Explain(Sightings(HistoryWorld())).places().empty());
}

}  // namespace
}  // namespace sslcd
