// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/eval/trajectory_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "sslcd/core/error.h"

namespace sslcd {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::vector<Pose> At(const std::vector<Vec3>& positions) {
  std::vector<Pose> poses;
  for (const Vec3& p : positions) poses.push_back(Pose::Trans(p));
  return poses;
}

std::vector<Pose> RandomPath(int n, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<Pose> poses(1);
  for (int i = 1; i < n; ++i) {
    Vec6 step;
    for (double& x : step) x = 0.3 * normal(random);
    poses.push_back(poses.back() * Pose::Exp(step));
  }
  return poses;
}

std::vector<Pose> Moved(const Similarity& S, const std::vector<Pose>& poses) {
  std::vector<Pose> moved;
  for (const Pose& T : poses) moved.push_back(S * T);
  return moved;
}

TEST(AteTest, RecoversTheMotionThatEachAlignmentMayUndo) {
  const std::vector<Pose> ref = RandomPath(40, 3);
  struct Case {
    Alignment alignment;
    Similarity S;
  };
  const Case cases[] = {
      {Alignment::kNone, {}},
      {Alignment::k4Dof, {1, Pose(lie::SO3<double>::Exp(Vec3(0, 2.8, 0)), Vec3(3, -2, 9))}},
      {Alignment::kSe3, {1, Pose(lie::SO3<double>::Exp(Vec3(1.2, -0.4, 2.1)), Vec3(-100, 50, 7))}},
      {Alignment::kSim3, {0.7, Pose(lie::SO3<double>::Exp(Vec3(-0.2, 3.0, 0.1)), Vec3(1, 2, 3))}},
  };
  for (const Case& c : cases) {
    // est is what S maps onto ref.
    const Pose inverse = c.S.T_ref_est.inverse();
    const Similarity undo{1 / c.S.scale, Pose(inverse.so3(), inverse.translation() / c.S.scale)};
    const AteResult ate = ComputeAte(Moved(undo, ref), ref, c.alignment);
    EXPECT_LT(ate.error.max, 1e-9) << ToString(c.alignment);
    EXPECT_NEAR(ate.S_ref_est.scale, c.S.scale, 1e-12);
    EXPECT_LT((ate.S_ref_est.T_ref_est.inverse() * c.S.T_ref_est).Log().norm(), 1e-9)
        << ToString(c.alignment);
    EXPECT_TRUE(ate.unique);
    EXPECT_EQ(ate.error.count, 40);
  }
}

TEST(AteTest, FreerAlignmentsAreNeverWorse) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const std::vector<Pose> est = RandomPath(30, seed), ref = RandomPath(30, seed + 100);
    double last = std::numeric_limits<double>::infinity();
    for (const Alignment alignment :
         {Alignment::kNone, Alignment::k4Dof, Alignment::kSe3, Alignment::kSim3}) {
      const double rmse = ComputeAte(est, ref, alignment).error.rmse;
      EXPECT_LE(rmse, last + 1e-12);
      last = rmse;
    }
  }
}

TEST(AteTest, FourDofTurnsAboutTheGivenUpOnly) {
  const Vec3 up(0.1, -0.2, 0.97);
  const Pose turn(lie::SO3<double>::Exp(up.normalized() * 1.9), Vec3(4, 5, 6));
  const std::vector<Pose> est = RandomPath(25, 8);
  const AteResult ate = ComputeAte(est, Moved({1, turn}, est), Alignment::k4Dof, up);
  EXPECT_LT(ate.error.max, 1e-9);
  EXPECT_GT(ComputeAte(est, Moved({1, turn}, est), Alignment::k4Dof, Vec3::UnitX()).error.rmse,
            0.1);
  EXPECT_THROW(ComputeAte(est, est, Alignment::k4Dof, Vec3::Zero()), Error);
  EXPECT_THROW(ComputeAte(est, est, Alignment::k4Dof, Vec3(0, kNan, 0)), Error);
}

TEST(AteTest, AMirroredPathIsNotAlignedByAReflection) {
  const std::vector<Pose> ref = At({{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 4}});
  const std::vector<Pose> mirrored = At({{0, 0, 0}, {-2, 0, 0}, {0, 3, 0}, {0, 0, 4}});
  const AteResult ate = ComputeAte(mirrored, ref, Alignment::kSe3);
  EXPECT_GT(ate.error.rmse, 0.3);
  EXPECT_NEAR(ate.S_ref_est.T_ref_est.so3().matrix().determinant(), 1, 1e-12);
}

TEST(AteTest, ThePosesTurnWithTheirPositions) {
  const Similarity S{2, Pose(lie::SO3<double>::RotZ(M_PI / 2), Vec3(1, 0, 0))};
  const Pose T = S * Pose(lie::SO3<double>::RotX(0.3), Vec3(1, 2, 3));
  EXPECT_LT((T.translation() - Vec3(-3, 2, 6)).norm(), 1e-12);
  EXPECT_LT(
      (T.so3().matrix() - (lie::SO3<double>::RotZ(M_PI / 2) * lie::SO3<double>::RotX(0.3)).matrix())
          .norm(),
      1e-12);
}

struct OpenCase {
  const char* name;
  std::vector<Pose> est, ref;
  double se3_rmse;
};

TEST(AteTest, PositionsThatLeaveTheAlignmentOpenStillHaveAnError) {
  const std::vector<OpenCase> cases = {
      {"one pose", At({{1, 2, 3}}), At({{7, 8, 9}}), 0.},
      {"two poses of equal distance", At({{0, 0, 0}, {1, 0, 0}}), At({{5, 5, 5}, {5, 6, 5}}), 0.},
      {"two poses, one metre longer", At({{0, 0, 0}, {1, 0, 0}}), At({{0, 0, 0}, {0, 0, 2}}), 0.5},
      {"all equal", At({{4, 4, 4}, {4, 4, 4}, {4, 4, 4}}), At({{0, 0, 0}, {0, 3, 0}, {0, -3, 0}}),
       std::sqrt(6.)},
      {"all equal, large numbers", At(std::vector<Vec3>(7, {1e6 + 0.1, 0.1, 0.3})),
       At(std::vector<Vec3>(7, {3, 0, 0})), 0},
      {"on one line", At({{0, 0, 0}, {1, 1, 1}, {3, 3, 3}, {9, 9, 9}}),
       At({{0, 0, 0}, {0, 0, std::sqrt(3.)}, {0, 0, std::sqrt(27.)}, {0, 0, std::sqrt(243.)}}), 0.},
  };
  for (const OpenCase& c : cases) {
    const AteResult se3 = ComputeAte(c.est, c.ref, Alignment::kSe3);
    EXPECT_NEAR(se3.error.rmse, c.se3_rmse, 1e-8) << c.name;
    EXPECT_FALSE(se3.unique) << c.name;
    EXPECT_TRUE(se3.S_ref_est.T_ref_est.matrix().allFinite()) << c.name;
    const AteResult sim3 = ComputeAte(c.est, c.ref, Alignment::kSim3);
    EXPECT_LE(sim3.error.rmse, c.se3_rmse + 1e-8) << c.name;
    EXPECT_TRUE(std::isfinite(sim3.S_ref_est.scale)) << c.name;
    EXPECT_FALSE(sim3.unique) << c.name;
    const AteResult yaw = ComputeAte(c.est, c.ref, Alignment::k4Dof);
    EXPECT_GE(yaw.error.rmse, c.se3_rmse - 1e-8) << c.name;
    EXPECT_TRUE(yaw.S_ref_est.T_ref_est.matrix().allFinite()) << c.name;
  }
  EXPECT_EQ(ComputeAte(cases[3].est, cases[3].ref, Alignment::kSim3).S_ref_est.scale, 1);
}

TEST(AteTest, BadInputIsNamed) {
  const std::vector<Pose> good = RandomPath(5, 1);
  std::vector<Pose> bad = good;
  bad[3].translation().y() = kNan;
  const auto message = [](const std::vector<Pose>& est,
                          const std::vector<Pose>& ref) -> std::string {
    try {
      ComputeAte(est, ref);
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::kBadInput);
      return e.what();
    }
    return "no error";
  };
  EXPECT_NE(message(bad, good).find("pose 3 of the estimate"), std::string::npos);
  EXPECT_NE(message(good, bad).find("pose 3 of the reference"), std::string::npos);
  EXPECT_NE(message({}, {}).find("empty"), std::string::npos);
  EXPECT_NE(message(good, RandomPath(7, 1)).find("5 poses and the reference 7"), std::string::npos);
  EXPECT_THROW(ComputeRpe(bad, good), Error);
  EXPECT_THROW(Align(bad, good, Alignment::kNone), Error);
}

TEST(AlignmentTest, NamesGoBothWays) {
  for (const Alignment a :
       {Alignment::kNone, Alignment::k4Dof, Alignment::kSe3, Alignment::kSim3}) {
    EXPECT_EQ(ParseAlignment(ToString(a)), a);
  }
  EXPECT_THROW(ParseAlignment("SE3"), Error);
}

TEST(SummariseTest, KnownLists) {
  const ErrorStats none = Summarise({});
  EXPECT_EQ(none.count, 0);
  EXPECT_EQ(none.rmse, 0);
  const ErrorStats stats = Summarise({4, 1, 3, 2});
  EXPECT_EQ(stats.count, 4);
  EXPECT_DOUBLE_EQ(stats.mean, 2.5);
  EXPECT_DOUBLE_EQ(stats.median, 2.5);
  EXPECT_DOUBLE_EQ(stats.rmse, std::sqrt(7.5));
  EXPECT_DOUBLE_EQ(stats.std, std::sqrt(1.25));
  EXPECT_EQ(stats.max, 4);
  EXPECT_EQ(Summarise({5, 1, 2}).median, 2);
}

TEST(MatchByStampTest, TakesTheNearestWithinTheLimit) {
  const Trajectory est{{0.0, 1.0, 2.04, 3.2}, At({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}})};
  Trajectory ref;
  for (int i = 0; i < 40; ++i) {
    ref.stamps.push_back(0.1 * i + 0.01);
    ref.poses.push_back(Pose::Trans(0, i, 0));
  }
  const MatchedPoses matched = MatchByStamp(est, ref, 0.031);
  ASSERT_EQ(matched.est.size(), 4u);  // 2.04 - 2.01 is within the limit
  EXPECT_EQ(matched.ref[0].translation().y(), 0);
  EXPECT_EQ(matched.ref[1].translation().y(), 10);
  EXPECT_EQ(matched.ref[2].translation().y(), 20);
  EXPECT_EQ(MatchByStamp(est, ref, 0.02).est.size(), 3u);
  const MatchedPoses swapped = MatchByStamp(ref, est, 0.02);
  ASSERT_EQ(swapped.ref.size(), 3u);
  EXPECT_EQ(swapped.ref[2].translation().x(), 3);
}

TEST(MatchByStampTest, BadStamps) {
  const Trajectory good{{0, 1}, At({{0, 0, 0}, {1, 0, 0}})};
  const Trajectory backwards{{1, 0}, good.poses}, nan{{0, kNan}, good.poses},
      short_of{{0}, good.poses};
  const Trajectory elsewhere{{100, 101}, good.poses};
  EXPECT_THROW(MatchByStamp(backwards, good), Error);
  EXPECT_THROW(MatchByStamp(good, nan), Error);
  EXPECT_THROW(MatchByStamp(short_of, good), Error);
  EXPECT_THROW(MatchByStamp({}, {}), Error);
  try {
    MatchByStamp(good, elsewhere);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::kNoSolution);
    EXPECT_NE(std::string(e.what()).find("100.0"), std::string::npos) << e.what();
  }
}

TEST(RpeTest, AConstantErrorPerStep) {
  std::vector<Pose> ref(1), est(1, Pose::Trans(5, 5, 5));
  for (int i = 0; i < 20; ++i) {
    ref.push_back(ref.back() * Pose::Trans(0, 0, 1));
    est.push_back(est.back() * Pose::Trans(0, 0, 1.1) * Pose::RotY(0.01));
  }
  const RpeResult one = ComputeRpe(est, ref);
  EXPECT_EQ(one.translation.count, 20);
  EXPECT_NEAR(one.translation.rmse, 0.1, 1e-12);
  EXPECT_NEAR(one.rotation_rad.max, 0.01, 1e-12);
  EXPECT_EQ(ComputeRpe(est, ref, {6, DeltaUnit::kFrames, false}).rotation_rad.count, 3);
  EXPECT_NEAR(ComputeRpe(est, ref, {6, DeltaUnit::kFrames, false}).rotation_rad.mean, 0.06, 1e-12);
  EXPECT_EQ(ComputeRpe(est, ref, {6, DeltaUnit::kFrames, true}).translation.count, 15);
  // 3.3 m each
  EXPECT_EQ(ComputeRpe(est, ref, {3, DeltaUnit::kMetres, false}).translation.count, 6);
}

TEST(RpeTest, TooShortAndBadDeltas) {
  const std::vector<Pose> path = RandomPath(4, 2);
  EXPECT_EQ(ComputeRpe(path, path, {4, DeltaUnit::kFrames, false}).translation.count, 0);
  EXPECT_EQ(ComputeRpe(path, path, {1e6, DeltaUnit::kMetres, true}).translation.count, 0);
  EXPECT_EQ(ComputeRpe({path[0]}, {path[0]}).translation.count, 0);
  EXPECT_EQ(ComputeRpe({path[0]}, {path[0]}, {1, DeltaUnit::kMetres, true}).translation.count, 0);
  for (const double delta : {0., -1., 1.5, kNan, 1. / 0.}) {
    EXPECT_THROW(ComputeRpe(path, path, {delta, DeltaUnit::kFrames, false}), Error) << delta;
  }
  EXPECT_NO_THROW(ComputeRpe(path, path, {1.5, DeltaUnit::kMetres, false}));
}

}  // namespace
}  // namespace sslcd
