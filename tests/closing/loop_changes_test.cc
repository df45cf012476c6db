// SPDX-License-Identifier: BSD-3-Clause
#include "closing/loop_changes.h"

#include <gtest/gtest.h>

#include <vector>

#include "loops_of_a_line.h"

namespace sslcd {
namespace {

TEST(LoopChanges, TellsOfNewDecisionsAndMeasurementsOnce) {
  LoopLedger ledger;
  LoopChanges changes;
  EXPECT_TRUE(changes.Take(ledger).empty());
  ledger.Add(Loop(1, 50, kOpen), {}, 50);
  ledger.Add(Loop(2, 60, kAccepted), {}, 60);
  ledger.AcceptNewest();
  EXPECT_EQ(IdsOf(changes.Take(ledger)), (std::vector<int>{0, 1}));
  ledger.attempts();  // somebody looks at them
  EXPECT_TRUE(changes.Take(ledger).empty());

  LoopClosure again = ledger.attempts()[1].row();
  again.T_match_query = Pose::Trans(0, 0, 0.1);
  ledger.attempts()[1].remeasured = again;
  const std::vector<LoopClosure> measured = changes.Take(ledger);
  ASSERT_EQ(IdsOf(measured), (std::vector<int>{1}));
  EXPECT_EQ(measured[0].T_match_query.translation().z(), 0.1);

  ledger.attempts()[1].row().decision = kOpen;
  EXPECT_EQ(IdsOf(changes.Take(ledger)), (std::vector<int>{1}));
  EXPECT_TRUE(changes.Take(ledger).empty());
}

TEST(LoopChanges, LoopsThatHaveEndedComeInTheOrderOfTheirIds) {
  const FrameStore frames = Line(120);
  LoopLedger ledger;
  LoopChanges changes;
  ledger.Add(Loop(1, 35, kAccepted), {}, 60);
  ledger.AcceptNewest();
  std::vector<int> early;
  for (int i = 1; i <= 40; ++i) {
    ledger.AddEarly(Loop(6, 40 + i, kAccepted), 60);
    early.push_back(i);
  }
  EXPECT_EQ(changes.Take(ledger).size(), 41u);
  ledger.DropEarly(frames, 120);
  const std::vector<LoopClosure> ended = changes.Take(ledger);
  EXPECT_EQ(IdsOf(ended), early);
  for (const LoopClosure& row : ended) EXPECT_EQ(row.decision, LoopDecision::kNone);
}

// What a host knows of a ledger is taken over for another one, in which some loops are missing.
TEST(LoopChanges, OfTheLoopsOfAnotherLedgerOnlyAcceptedOnesAreLost) {
  LoopLedger ledger;
  std::vector<int> accepted;
  for (int i = 0; i < 40; ++i) {
    ledger.Add(Loop(1, 40 + i, i % 2 == 0 ? kAccepted : kOpen), {}, 90);
    if (i % 2 == 0) ledger.AcceptNewest(), accepted.push_back(i);
  }
  LoopChanges told, changes;
  told.Take(ledger);
  LoopLedger other;
  other.ReserveIds(ledger);
  changes.TakeOver(told, other, 200);
  const std::vector<LoopClosure> lost = changes.Take(other);
  EXPECT_EQ(IdsOf(lost), accepted);
  for (const LoopClosure& row : lost) EXPECT_EQ(row.decision, LoopDecision::kNone);
  EXPECT_TRUE(changes.Take(other).empty());
}

TEST(LoopChanges, OnlyAttemptsFromTheFirstNewFrameOnAreToldAgain) {
  LoopLedger ledger;
  for (const int newest : {60, 70, 80}) {
    ledger.Add(Loop(1, newest - 25, kAccepted), {}, newest);
    ledger.AcceptNewest();
  }
  LoopChanges told, changes;
  told.Take(ledger);
  changes.TakeOver(told, ledger, 70);
  EXPECT_EQ(IdsOf(changes.Take(ledger)), (std::vector<int>{1, 2}));

  LoopLedger young;  // hardly changed yet
  young.Add(Loop(1, 25, kOpen), {}, 50);
  LoopChanges of_young;
  of_young.TakeOver(LoopChanges(), young, 0);
  EXPECT_EQ(IdsOf(of_young.Take(young)), (std::vector<int>{0}));
}

TEST(LoopChanges, AnEarlyLoopThatEndsBeforeItIsToldAgainIsToldAsEnded) {
  const FrameStore frames = Line(80);
  LoopLedger ledger, copy;
  LoopChanges told, changes;
  for (LoopLedger* one : {&ledger, &copy}) {
    one->Add(Loop(1, 35, kAccepted), {}, 60);
    one->AcceptNewest();
    one->AddEarly(Loop(6, 40, kAccepted), 60);
  }
  told.Take(ledger);
  copy.ReserveIds(ledger);
  changes.TakeOver(told, copy, 60);
  copy.DropEarly(frames, 80);
  const std::vector<LoopClosure> rows = changes.Take(copy);
  ASSERT_EQ(IdsOf(rows), (std::vector<int>{0, 1}));
  EXPECT_EQ(rows[1].decision, LoopDecision::kNone);
}

}  // namespace
}  // namespace sslcd
