// SPDX-License-Identifier: BSD-3-Clause
#include "loop_book.h"

#include <gtest/gtest.h>

#include <vector>

namespace sslcd::vins {
namespace {

// Every metre a keyframe, along x; the camera looks along the body's x axis.
Keyframe At(int index, int sequence = 1) {
  Keyframe keyframe;
  keyframe.index = index;
  keyframe.sequence = sequence;
  keyframe.T_odom_body = Pose::Trans(index, 0, 0);
  keyframe.T_body_cam =
      Pose(lie::SO3<double>::RotZ(-M_PI / 2) * lie::SO3<double>::RotX(-M_PI / 2), {0.1, 0.2, 0.3});
  return keyframe;
}

LoopBook Road(int keyframes) {
  LoopBook book;
  for (int i = 0; i < keyframes; ++i) book.AddKeyframe(At(i));
  return book;
}

LoopClosure Loop(int id, int query, int match, double sigma = 0.1) {
  LoopClosure loop;
  loop.id = id;
  loop.query_frame = query;
  loop.match_frame = match;
  loop.decision = LoopDecision::kAccepted;
  loop.T_match_query = Pose(lie::SO3<double>::RotY(3.), {1, 0, 4});
  loop.covariance *= sigma * sigma;
  return loop;
}

LoopClosure Withdrawn(LoopClosure loop) {
  loop.decision = LoopDecision::kNone;
  return loop;
}

TEST(LoopBook, EdgeIsBetweenBodiesInTheOdometrysUnit) {
  const LoopClosure loop = Loop(3, 40, 7);
  const Keyframe cur = At(40), old = At(7);
  const double scale = 1.25;
  const LoopEdge edge = EdgeBetween(loop, cur, old, scale);
  EXPECT_EQ(edge.cur, 40);
  EXPECT_EQ(edge.old, 7);
  const Pose T_cams = old.T_body_cam.inverse() * edge.measured.T_a_b * cur.T_body_cam;
  EXPECT_LT((T_cams.translation() * scale - loop.T_match_query.translation()).norm(), 1e-12);
  EXPECT_LT((T_cams.so3().inverse() * loop.T_match_query.so3()).Log().norm(), 1e-12);
}

TEST(LoopBook, CovarianceIsThatOfTheBodies) {
  LoopClosure loop = Loop(0, 40, 7);
  loop.covariance.diagonal() << 0.04, 0.01, 0.09, 1e-4, 4e-4, 1e-4;
  const Keyframe cur = At(40), old = At(7);
  const double scale = 1.25;
  const LoopEdge edge = EdgeBetween(loop, cur, old, scale);
  Pose::Matrix6 expected = Pose::Matrix6::Zero();
  for (int i = 0; i < 6; ++i) {
    Vec6 d = Vec6::Zero();
    d[i] = 1e-6;
    LoopClosure other = loop;
    other.T_match_query = loop.T_match_query * Pose::Exp(d);
    const Pose T_old_cur = EdgeBetween(other, cur, old, scale).measured.T_a_b;
    const Vec6 moved = (edge.measured.T_a_b.inverse() * T_old_cur).Log() / 1e-6;
    expected += loop.covariance(i, i) * moved * moved.transpose();
  }
  EXPECT_LT((edge.measured.covariance - expected).norm(), 1e-5 * expected.norm());
}

TEST(LoopBook, HandsOverAcceptedLoopsOnce) {
  LoopBook book = Road(60);
  const EdgeChanges first = book.Update({Loop(0, 40, 7), Withdrawn(Loop(1, 41, 8))}, 1);
  ASSERT_EQ(first.set.size(), 1u);
  EXPECT_EQ(first.set[0].cur, 40);
  EXPECT_TRUE(first.cleared.empty());
  EXPECT_TRUE(book.Update({}, 1).empty());
  EXPECT_TRUE(book.Update({Loop(0, 40, 7)}, 1).empty()) << "nothing has changed";
}

TEST(LoopBook, TakesBackWhatIsWithdrawn) {
  LoopBook book = Road(60);
  book.Update({Loop(0, 40, 7), Loop(1, 50, 8)}, 1);
  const EdgeChanges changes = book.Update({Withdrawn(Loop(0, 40, 7))}, 1);
  EXPECT_EQ(changes.cleared, std::vector<int>{40});
  EXPECT_TRUE(changes.set.empty());
  EXPECT_EQ(book.accepted(), 1);
  EXPECT_EQ(book.Update({Loop(0, 40, 7)}, 1).set.size(), 1u) << "accepted again";
}

TEST(LoopBook, TheMoreExactOfTwoLoopsKeepsTheKeyframeAndTheOtherMoves) {
  LoopBook book = Road(60);
  book.Update({Loop(0, 40, 7, 0.2)}, 1);
  const EdgeChanges changes = book.Update({Loop(1, 40, 8, 0.1)}, 1);
  ASSERT_EQ(book.edges().size(), 2u);
  EXPECT_EQ(book.edges().at(40).id, 1);
  const LoopEdge& moved = book.edges().at(39);
  EXPECT_EQ(moved.id, 0);
  EXPECT_EQ(changes.set.size(), 2u);
  // the same loop, seen from one metre before
  const Pose T_old_40 = EdgeBetween(Loop(0, 40, 7, 0.2), At(40), At(7), 1).measured.T_a_b;
  EXPECT_LT(((moved.measured.T_a_b * Pose::Trans(1, 0, 0)).inverse() * T_old_40).Log().norm(),
            1e-12);
  EXPECT_GT(moved.measured.covariance(0, 0), 0.04);
  EXPECT_EQ(book.Update({Withdrawn(Loop(1, 40, 8))}, 1).cleared, std::vector<int>{39});
  EXPECT_EQ(book.edges().at(40).id, 0) << "and moves back";
}

TEST(LoopBook, VinssOwnLoopStays) {
  LoopBook book = Road(60);
  Keyframe own = At(40);
  own.has_own_loop = true;
  book.AddKeyframe(own);
  book.Update({Loop(0, 40, 7)}, 1);
  EXPECT_EQ(book.edges().count(40), 0u);
  EXPECT_EQ(book.edges().count(39), 1u);
}

TEST(LoopBook, ALoopMovesNeitherFarNorToAnotherSequence) {
  LoopBook book = Road(40);
  for (int i = 40; i < 60; ++i) book.AddKeyframe(At(i, 2));
  std::vector<LoopClosure> loops;
  for (int id = 0; id < 20; ++id) loops.push_back(Loop(id, 40, 7 + id, 0.1 + 0.01 * id));
  book.Update(loops, 1);
  ASSERT_EQ(book.edges().size(), 1u + LoopBook::kMostMoved);
  for (const auto& [cur, edge] : book.edges()) {
    EXPECT_GE(cur, 40);
    EXPECT_LE(cur, 40 + LoopBook::kMostMoved);
  }
  EXPECT_EQ(book.accepted(), 20) << "the others wait";
  book.Update({Withdrawn(loops[0])}, 1);
  EXPECT_EQ(book.edges().size(), 1u + LoopBook::kMostMoved) << "one of them has its turn";
}

TEST(LoopBook, ALoopToAKeyframeThatVinsDroppedIsLeftOut) {
  LoopBook book = Road(60);
  EXPECT_TRUE(book.Update({Loop(0, 70, 7), Loop(1, 40, -3)}, 1).empty());
  EXPECT_EQ(book.Find(70), nullptr);
}

TEST(LoopBook, ALoopIsHandedOverAgainWhenTheScaleHasMoved) {
  LoopBook book = Road(60);
  book.Update({Loop(0, 40, 7)}, 1);
  EXPECT_TRUE(book.Update({}, 1.0005).empty()) << "2 mm";
  EXPECT_EQ(book.Update({}, 1.01).set.size(), 1u);
  double scale = 1.01;
  int handed_over = 0;
  for (int i = 0; i < 20; ++i) {
    scale += 0.0005;
    handed_over += static_cast<int>(book.Update({}, scale).set.size());
  }
  EXPECT_GT(handed_over, 0) << "small changes add up";
  EXPECT_LT(handed_over, 20);
}

}  // namespace
}  // namespace sslcd::vins
