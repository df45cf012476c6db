// SPDX-License-Identifier: BSD-3-Clause
#include "closing/loop_ledger.h"

#include <gtest/gtest.h>

#include <vector>

#include "closing/loop_changes.h"
#include "loops_of_a_line.h"

namespace sslcd {
namespace {

TEST(LoopLedger, TwoCamerasAreEnteredOncePerNewestFrame) {
  LoopLedger ledger;
  EXPECT_TRUE(ledger.Add(Loop(3, 50, kOpen), {}, 60));
  EXPECT_FALSE(ledger.Add(Loop(3, 50, kOpen), {}, 60));
  EXPECT_TRUE(ledger.Add(Loop(4, 50, kOpen), {}, 60));
  EXPECT_TRUE(ledger.Add(Loop(3, 51, kOpen), {}, 60));
  EXPECT_TRUE(ledger.Add(Loop(3, 50, kOpen), {}, 65));
  EXPECT_EQ(ledger.Rows().size(), 4u);
  EXPECT_EQ(ledger.Rows()[3].newest_frame, 65);
}

// The ledger of a copy that replaces its original.
TEST(LoopLedger, AnAttemptThatAnotherLedgerHasMadeToo) {
  LoopLedger ledger;
  ledger.Add(Loop(1, 50, kAccepted), {}, 60);
  ledger.AcceptNewest();
  LoopLedger copy = ledger;
  LoopChanges told;
  for (const int query : {51, 52, 53}) {
    ledger.Add(Loop(2, query, kAccepted), {}, 70);
    ledger.AcceptNewest();
  }
  EXPECT_EQ(IdsOf(told.Take(ledger)), (std::vector<int>{0, 1, 2, 3}));
  copy.ReserveIds(ledger);
  for (const int query : {52, 54}) copy.Add(Loop(2, query, kAccepted), {}, 70);
  EXPECT_EQ(IdsOf(copy.Rows()), (std::vector<int>{0, 2, 4})) << "52 is the same, 54 is new";

  LoopChanges changes;
  changes.TakeOver(told, copy, 70);
  const std::vector<LoopClosure> rows = changes.Take(copy);
  ASSERT_EQ(IdsOf(rows), (std::vector<int>{1, 3, 2, 4})) << "0 is known";
  for (const int lost : {0, 1}) {
    EXPECT_EQ(rows[lost].decision, LoopDecision::kNone);
    EXPECT_EQ(rows[lost].newest_frame, 70);
  }
  EXPECT_EQ(rows[2].decision, kAccepted);
  EXPECT_TRUE(changes.Take(copy).empty());
}

TEST(LoopLedger, AnEarlyLoopEndsWhenItsCameraIsFarEnoughBackOrItsAttemptIsRefused) {
  const FrameStore frames = Line(80);
  LoopLedger ledger;
  LoopChanges changes;
  ledger.Add(Loop(1, 35, kAccepted), {}, 60);
  ledger.AcceptNewest();
  ledger.AddEarly(Loop(6, 40, kAccepted), 60);
  ledger.AddEarly(Loop(11, 45, kAccepted), 60);
  ledger.DropEarly(frames, 40);
  EXPECT_EQ(IdsOf(changes.Take(ledger)), (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(ledger.AcceptedEdges().size(), 1u);
  EXPECT_FALSE(ledger.AcceptedNear(frames, 40, 2));
  EXPECT_TRUE(ledger.AnyLoopNear(frames, 40, 2));
  EXPECT_FALSE(ledger.AnyLoopNear(frames, 42.5, 2));

  ledger.DropEarly(frames, 41);
  std::vector<LoopClosure> rows = changes.Take(ledger);
  ASSERT_EQ(IdsOf(rows), (std::vector<int>{1}));
  EXPECT_EQ(rows[0].decision, LoopDecision::kNone);
  EXPECT_EQ(rows[0].query_frame, 40);
  EXPECT_EQ(IdsOf(WithoutEarly(ledger.Rows())), (std::vector<int>{0}));

  ledger.attempts()[0].row().decision = kOpen;
  ledger.DropEarly(frames, 41);
  rows = changes.Take(ledger);
  ASSERT_EQ(IdsOf(rows), (std::vector<int>{0, 2}));
  EXPECT_TRUE(rows[1].early);
  EXPECT_EQ(rows[1].decision, LoopDecision::kNone);
  EXPECT_TRUE(changes.Take(ledger).empty());
}

TEST(LoopLedger, AnEarlyLoopOfAnotherLedgerKeepsItsId) {
  LoopLedger copy, ledger;
  ledger.Add(Loop(1, 35, kAccepted), {}, 60);
  ledger.AcceptNewest();
  ledger.AddEarly(Loop(6, 40, kAccepted), 60);
  copy.AddEarly(Loop(9, 50, kAccepted), 60);  // 0 is another one's
  copy.ReserveIds(ledger);
  copy.AddEarly(Loop(6, 40, kAccepted), 60);
  copy.Add(Loop(1, 35, kAccepted), {}, 60);
  EXPECT_EQ(IdsOf(copy.Rows()), (std::vector<int>{0, 2, 1})) << "attempts first";
}

TEST(LoopLedger, IdsOfEarlyLoopsThatHaveEndedAreNotUsedAgain) {
  const FrameStore frames = Line(80);
  LoopLedger ledger;
  ledger.Add(Loop(1, 35, kAccepted), {}, 60);
  ledger.AcceptNewest();
  LoopLedger copy = ledger;
  ledger.AddEarly(Loop(6, 40, kAccepted), 60);  // 1
  ledger.DropEarly(frames, 80);
  copy.Add(Loop(9, 20, kAccepted), {}, 50);
  copy.ReserveIds(ledger);
  EXPECT_EQ(IdsOf(copy.Rows()), (std::vector<int>{0, 2}));
}

TEST(LoopLedger, AnAttemptHasAnotherIdThanAnEarlyLoopOfTheSameCameras) {
  LoopLedger ledger, copy;
  ledger.AddEarly(Loop(6, 40, kAccepted), 60);
  copy.Add(Loop(6, 40, kAccepted), {}, 60);
  copy.ReserveIds(ledger);
  EXPECT_EQ(IdsOf(copy.Rows()), (std::vector<int>{1}));
}

TEST(LoopLedger, ATrackIsAcceptedWithItsConfirmedAttempts) {
  LoopLedger ledger;
  ledger.Add(Loop(1, 50, kOpen, 7, true), {}, 50);
  ledger.Add(Loop(2, 55, kOpen, 7, false), {}, 55);  // a poor measurement
  ledger.Add(Loop(3, 60, kOpen, 8, true), {}, 60);   // another track
  ledger.Add(Loop(4, 65, kAccepted, 7, true), {}, 65);
  EXPECT_FALSE(ledger.attempts()[0].accepted()) << "not before AcceptNewest";
  ledger.AcceptNewest();
  const std::vector<LoopClosure> rows = ledger.Rows();
  EXPECT_EQ(rows[0].decision, kAccepted);
  EXPECT_EQ(rows[0].reason, "settled by frame 65");
  EXPECT_EQ(rows[1].decision, kOpen);
  EXPECT_EQ(rows[2].decision, kOpen);
  EXPECT_EQ(rows[3].decision, kAccepted);
  EXPECT_EQ(rows[3].reason, "as found");
  EXPECT_EQ(ledger.AcceptedEdges().size(), 2u);
}

TEST(LoopLedger, OneAcceptedLoopIsAnAcceptedLoop) {
  LoopLedger ledger;
  EXPECT_FALSE(ledger.AnyAccepted()) << "no attempt at all";
  ledger.Add(Loop(1, 50, kOpen), {}, 50);
  EXPECT_FALSE(ledger.AnyAccepted());
  ledger.Add(Loop(4, 65, kAccepted), {}, 65);
  ledger.AcceptNewest();
  EXPECT_TRUE(ledger.AnyAccepted());
}

TEST(LoopLedger, LoopsWithoutATrackSettleNoOther) {
  LoopLedger ledger;
  ledger.Add(Loop(1, 50, kOpen, -1, true), {}, 50);
  ledger.Add(Loop(4, 65, kAccepted, -1, true), {}, 65);
  ledger.AcceptNewest();
  EXPECT_EQ(ledger.Rows()[0].decision, kOpen);
}

TEST(LoopLedger, WhatTheGraphRefusesStaysInItButIsNoShortcut) {
  const FrameStore frames = Line(100);
  LoopLedger ledger;
  ledger.Add(Loop(10, 90, kAccepted), {}, 95);
  ledger.AcceptNewest();
  EXPECT_EQ(ledger.AcceptedPath(frames).From(90).To(12), 2) << "across the loop";
  ledger.attempts()[0].row().decision = kOpen;
  EXPECT_FALSE(ledger.AnyAccepted());
  EXPECT_TRUE(ledger.attempts()[0].in_graph) << "may come back";
  EXPECT_EQ(ledger.AcceptedPath(frames).From(90).To(12), 78);
}

TEST(LoopLedger, TracksOfTheTwoSearchesAreDifferent) {
  LoopLedger ledger;
  SearchWindow second;
  second.second = true;
  ledger.Add(Loop(1, 50, kOpen, 7, true), {}, 50);
  ledger.Add(Loop(2, 60, kOpen, 7, true), second, 99);
  ledger.Add(Loop(3, 70, kAccepted, 7, true), second, 99);
  ledger.AcceptNewest();
  EXPECT_FALSE(ledger.attempts()[0].accepted());
  EXPECT_TRUE(ledger.attempts()[1].accepted());
}

TEST(LoopLedger, DropsWhatTheSecondSearchHasNotAccepted) {
  LoopLedger ledger;
  ledger.Add(Loop(1, 50, kOpen), {}, 50);  // of the first search
  SearchWindow second;
  second.second = true;
  ledger.Add(Loop(2, 60, kOpen, 7, true), second, 99);
  ledger.Add(Loop(3, 70, kAccepted), second, 99);
  ledger.AcceptNewest();
  EXPECT_EQ(ledger.Rows().size(), 2u) << "the refused one is no attempt of the run";
  ledger.DropUnacceptedOfSecond();
  ASSERT_EQ(ledger.attempts().size(), 2u);
  EXPECT_EQ(ledger.attempts()[0].found.loop.query, 50);
  EXPECT_EQ(ledger.attempts()[1].found.loop.query, 70);
}

TEST(LoopLedger, AcceptedNearLooksAtQueryCameras) {
  const FrameStore frames = Line(100);
  LoopLedger ledger;
  ledger.Add(Loop(10, 90, kAccepted), {}, 95);
  ledger.AcceptNewest();
  ledger.Add(Loop(40, 60, kOpen), {}, 96);
  EXPECT_FALSE(ledger.AcceptedNear(frames, 60, 2.5)) << "not accepted";
  EXPECT_TRUE(ledger.AcceptedNear(frames, 92, 2.5));
  EXPECT_FALSE(ledger.AcceptedNear(frames, 93, 2.5));
  EXPECT_FALSE(ledger.AcceptedNear(frames, 10, 2.5)) << "that is the match camera";
}

TEST(LoopLedger, KnowsFusionsOfLoopsThatAreNoLongerAccepted) {
  LoopLedger ledger;
  ledger.Add(Loop(1, 50, kOpen), {}, 50);
  ledger.Add(Loop(4, 65, kAccepted), {}, 65);
  ledger.AcceptNewest();
  EXPECT_FALSE(ledger.FusedByRefused()) << "the refused one has fused nothing";
  ledger.attempts()[1].fused = true;
  EXPECT_FALSE(ledger.FusedByRefused());
  ledger.attempts()[1].row().decision = kOpen;
  EXPECT_TRUE(ledger.FusedByRefused());
  ledger.ForgetFusions();
  EXPECT_FALSE(ledger.FusedByRefused());
}

TEST(LoopLedger, RowsAreAsMeasuredLastWhereAccepted) {
  LoopLedger ledger;
  ledger.Add(Loop(1, 50, kAccepted), {}, 50);
  ledger.AcceptNewest();
  LoopClosure again = ledger.attempts()[0].row();
  again.T_match_query = Pose::Trans(1, 0, 0);
  again.reason = "not taken over";
  ledger.attempts()[0].remeasured = again;
  EXPECT_EQ(ledger.Rows()[0].T_match_query.translation().x(), 1);
  EXPECT_EQ(ledger.Rows()[0].reason, "as found");
  ledger.attempts()[0].row().decision = kOpen;
  EXPECT_EQ(ledger.Rows()[0].T_match_query.translation().x(), 0);
}

}  // namespace
}  // namespace sslcd
