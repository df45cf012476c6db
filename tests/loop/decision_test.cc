// SPDX-License-Identifier: BSD-3-Clause
#include "loop/decision.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace sslcd {
namespace {

double Minus1000() { return -1000; }

TEST(DecideSingleLook, TheScoreIsTheLogOddsAgainstAllRivalsAndChance) {
  SingleLookOptions options;
  options.min_evidence = 1;
  const LoopVerdict verdict = DecideSingleLook({{8, 5, 3}, 6}, Minus1000, options);
  EXPECT_NEAR(verdict.score, 8 - std::log(std::exp(5) + std::exp(3) + std::exp(1)), 1e-12);
  EXPECT_NEAR(verdict.second_score, 5 - std::log(std::exp(8) + std::exp(3) + std::exp(1)), 1e-12);
  EXPECT_EQ(verdict.decision, LoopDecision::kAccepted);
  EXPECT_EQ(verdict.reason, "6 objects agree");
}

TEST(DecideSingleLook, WithoutARivalTheSecondScoreIsThatOfChance) {
  SingleLookOptions options;
  options.min_evidence = -2;
  const LoopVerdict verdict = DecideSingleLook({{3}, 6}, Minus1000, options);
  EXPECT_NEAR(verdict.score, 5, 1e-12);
  EXPECT_NEAR(verdict.second_score, -5, 1e-12);
}

TEST(DecideSingleLook, RefusesWhatChanceReaches) {
  SingleLookOptions options;
  options.min_evidence = 4;
  options.min_margin = -100;
  EXPECT_EQ(DecideSingleLook({{4}, 6}, Minus1000, options).decision, LoopDecision::kAccepted);
  const LoopVerdict refused = DecideSingleLook({{3.9}, 6}, Minus1000, options);
  EXPECT_EQ(refused.decision, LoopDecision::kNone);
  EXPECT_THAT(refused.reason, testing::HasSubstr("chance"));
}

TEST(DecideSingleLook, IsAmbiguousBelowTheMargin) {
  SingleLookOptions options;
  options.min_evidence = 0;
  options.min_margin = 4;
  EXPECT_EQ(DecideSingleLook({{4}, 6}, Minus1000, options).decision, LoopDecision::kAccepted);
  const LoopVerdict refused = DecideSingleLook({{3.9}, 6}, Minus1000, options);
  EXPECT_EQ(refused.decision, LoopDecision::kAmbiguous);
  EXPECT_THAT(refused.reason, testing::HasSubstr("other poses"));
}

TEST(DecideSingleLook, ABetterMirrorImageRefutesAndIsAskedLast) {
  SingleLookOptions options;
  options.mirror_gain = 2;
  int asked = 0;
  const auto mirror = [&asked](double evidence) {
    return [&asked, evidence] {
      ++asked;
      return evidence;
    };
  };
  EXPECT_EQ(DecideSingleLook({{7}, 6}, mirror(9), options).decision, LoopDecision::kAccepted);
  const LoopVerdict refused = DecideSingleLook({{7}, 6}, mirror(9.1), options);
  EXPECT_EQ(refused.decision, LoopDecision::kNone);
  EXPECT_THAT(refused.reason, testing::HasSubstr("mirror"));
  EXPECT_EQ(asked, 2);
  DecideSingleLook({{7, 7}, 6}, mirror(0), options);
  EXPECT_EQ(asked, 2) << "two equal poses are ambiguous anyway";
}

TEST(DecideSingleLook, WhatTheSearchLeftOutIsARival) {
  SingleLookOptions options;
  options.min_evidence = 0;
  options.min_margin = 2;
  SingleLook look{{8, 3}, 6};
  look.left_out = 4;
  const LoopVerdict verdict = DecideSingleLook(look, Minus1000, options);
  EXPECT_NEAR(verdict.score, 8 - std::log(std::exp(3) + std::exp(4) + std::exp(0)), 1e-12);
  EXPECT_EQ(verdict.decision, LoopDecision::kAccepted);
  look.left_out = 7;
  EXPECT_EQ(DecideSingleLook(look, Minus1000, options).decision, LoopDecision::kAmbiguous);
}

// A track that everything speaks for.
TrackEvidence GoodTrack() {
  TrackEvidence track;
  track.evidence = 30;
  track.margin = 20;
  track.second_margin = -21;
  track.own_evidence = 5;
  track.heading_sigma_rad = 0.01;
  return track;
}

LoopAcceptanceOptions Acceptance() {
  LoopAcceptanceOptions options;
  options.max_risk = 0.01;  // log odds of 4.595
  options.max_heading_sigma_rad = 0.04;
  return options;
}

// Where nothing but the track's own 2.5 m^2 rad was searched, the fit's evidence is the track's.
TEST(EvidenceOnTrack, IsThatOfTheFitWithoutTheRestOfTheMap) {
  EXPECT_NEAR(EvidenceOnTrack(-3, 2.5), -3, 1e-12);
  // On a map twice as large the same fit has log 2 less evidence, and the same on its track.
  EXPECT_NEAR(EvidenceOnTrack(-3 - std::log(2), 2000), EvidenceOnTrack(-3, 1000), 1e-12);
}

TEST(DecideTrack, AcceptsWhatEverythingSpeaksFor) {
  const TrackVerdict verdict = DecideTrack(GoodTrack(), Acceptance());
  EXPECT_EQ(verdict.loop.decision, LoopDecision::kAccepted);
  EXPECT_TRUE(verdict.confirmed);
  EXPECT_EQ(verdict.loop.score, 20);
  EXPECT_EQ(verdict.loop.second_score, -21);
}

TEST(DecideTrack, ARiskAboveTheBarIsAmbiguousButConfirmed) {
  TrackEvidence track = GoodTrack();
  track.margin = 4.6;
  EXPECT_EQ(DecideTrack(track, Acceptance()).loop.decision, LoopDecision::kAccepted);
  track.margin = 4.59;
  const TrackVerdict verdict = DecideTrack(track, Acceptance());
  EXPECT_EQ(verdict.loop.decision, LoopDecision::kAmbiguous);
  EXPECT_TRUE(verdict.confirmed) << "accepted as soon as its track is";
  EXPECT_EQ(verdict.loop.reason, "another pose fits nearly as well");
}

TEST(DecideTrack, ATrackWorseThanChanceIsNone) {
  TrackEvidence track = GoodTrack();
  track.evidence = -0.1;
  track.margin = -1;
  const TrackVerdict verdict = DecideTrack(track, Acceptance());
  EXPECT_EQ(verdict.loop.decision, LoopDecision::kNone);
  EXPECT_EQ(verdict.loop.reason, "chance explains the best pose");
  track.evidence = 0;
  EXPECT_EQ(DecideTrack(track, Acceptance()).loop.decision, LoopDecision::kAmbiguous);
}

TEST(DecideTrack, APoorMeasurementIsNotAcceptedHoweverSureTheTrackIs) {
  struct Case {
    double TrackEvidence::*field;
    double good, bad;
    const char* reason;
  };
  for (const Case& c :
       {Case{&TrackEvidence::own_evidence, 0., -0.01, "too few objects of its own agree"},
        Case{&TrackEvidence::height, -3., -3.01, "odometry is at another height"},
        Case{&TrackEvidence::heading_sigma_rad, 0.0399, 0.04, "heading too uncertain"}}) {
    TrackEvidence track = GoodTrack();
    track.*c.field = c.good;
    EXPECT_TRUE(DecideTrack(track, Acceptance()).confirmed) << c.reason;
    track.*c.field = c.bad;
    const TrackVerdict verdict = DecideTrack(track, Acceptance());
    EXPECT_FALSE(verdict.confirmed);
    EXPECT_EQ(verdict.loop.decision, LoopDecision::kAmbiguous);
    EXPECT_EQ(verdict.loop.reason, c.reason);
  }
}

TEST(DecideTrack, ALoopWithoutOdometryNeedsALeadAndTheLooks) {
  TrackEvidence track = GoodTrack();
  track.joins = true;
  track.lead = 12;
  EXPECT_EQ(DecideTrack(track, Acceptance()).loop.decision, LoopDecision::kAccepted);
  track.lead = 11.9;
  const TrackVerdict verdict = DecideTrack(track, Acceptance());
  EXPECT_EQ(verdict.loop.decision, LoopDecision::kAmbiguous);
  EXPECT_TRUE(verdict.confirmed) << "accepted as soon as its track is";
  EXPECT_EQ(verdict.loop.reason, "too few objects agree where odometry says nothing");
  track.margin = 4;
  EXPECT_EQ(DecideTrack(track, Acceptance()).loop.reason, "another pose fits nearly as well");
  track.margin = 20;
  track.lead = 12;
  track.appearance = -2.9;
  EXPECT_EQ(DecideTrack(track, Acceptance()).loop.decision, LoopDecision::kAccepted);
  track.appearance = -3.1;
  EXPECT_EQ(DecideTrack(track, Acceptance()).loop.decision, LoopDecision::kAmbiguous);
  EXPECT_EQ(DecideTrack(track, Acceptance()).loop.reason, "the objects look different");
  track.joins = false;
  track.lead = -100;
  EXPECT_EQ(DecideTrack(track, Acceptance()).loop.decision, LoopDecision::kAccepted)
      << "where odometry speaks, too";
}

TEST(ApplyGraphVerdict, ARefusedLoopIsAmbiguousAndMayComeBack) {
  LoopClosure loop;
  loop.decision = LoopDecision::kAccepted;
  loop.reason = "7 objects agree";
  ApplyGraphVerdict(true, loop);
  EXPECT_EQ(loop.reason, "7 objects agree") << "nothing has changed";
  ApplyGraphVerdict(false, loop);
  EXPECT_EQ(loop.decision, LoopDecision::kAmbiguous);
  EXPECT_EQ(loop.reason, "contradicts other loops");
  ApplyGraphVerdict(true, loop);
  EXPECT_EQ(loop.decision, LoopDecision::kAccepted);
  EXPECT_EQ(loop.reason, "other loops agree after all");
}

TEST(IsWithdrawn, WhereTheTrajectoryIsOffByDistanceOrAngle) {
  LoopClosure loop;
  loop.T_match_query = Pose::Trans(3, 0, 40);
  LoopAcceptanceOptions options;
  options.withdraw_m = 2;
  options.withdraw_rad = 0.1;
  const auto off = [&](double metres, double rad) {
    const Pose error(lie::SO3<double>::RotY(rad), Vec3(0, 0, metres));
    return IsWithdrawn(loop, loop.T_match_query * error, options);
  };
  EXPECT_FALSE(off(0, 0));
  EXPECT_FALSE(off(1.99, 0.099));
  EXPECT_TRUE(off(2.01, 0));
  EXPECT_TRUE(off(0, 0.101));
  EXPECT_TRUE(IsWithdrawn(loop, Pose::Trans(std::nan(""), 0, 0), options));
}

}  // namespace
}  // namespace sslcd
