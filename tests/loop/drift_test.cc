// SPDX-License-Identifier: BSD-3-Clause
#include "loop/drift.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "drift_scene.h"

namespace sslcd {
namespace {

TEST(Drift, ExactPairsGiveTheDriftBack) {
  Random random(1);
  for (const Vec3& up : {kKittiUp, Vec3(0, 0, 1), Vec3(Vec3(1, 2, -3).normalized())}) {
    for (const Symmetry symmetry : {Symmetry::kNone, Symmetry::kPi, Symmetry::kFull}) {
      for (int trial = 0; trial < 20; ++trial) {
        Scene scene;
        scene.up = up;
        scene.symmetry = symmetry;
        scene.middle = Vec3(200, -100, 50);
        scene.objects = 2 + trial;
        scene.flipped = symmetry == Symmetry::kPi ? 0.5 : 0;
        scene.D = TurnAndShift(up, random.Uniform(-M_PI, M_PI), scene.middle,
                               Vec3(random.Uniform(-9, 9), 2, 30));
        for (const bool six_dof : {false, true}) {
          DriftOptions options = FourDof();
          options.six_dof = six_dof;
          const DriftResult result = SolveDrift(scene.Pairs(random), scene.gravity(), options);
          ASSERT_TRUE(result.usable) << result.reason;
          EXPECT_TRUE(result.converged);
          EXPECT_LT(Difference(result.T_global_local, scene.D), 1e-6);
          EXPECT_EQ(result.inliers, scene.objects);
          EXPECT_LT(result.rms_m, 1e-6);
        }
      }
    }
  }
}

/// What is left of 3.17 m of drift at the camera, on average over many scenes. [m]
struct Leftover {
  double printed = 0, repaired = 0, ours = 0, ours_flipped = 0;
};

Leftover CorrectDrift(const Vec3& middle) {
  constexpr int kScenes = 40;
  Random random(7);
  Leftover sum;
  for (int i = 0; i < kScenes; ++i) {
    Scene scene;
    scene.middle = middle;
    scene.D =
        TurnAndShift(scene.up, 0.05, middle, 3.17 * Vec3(std::cos(i), 0, std::sin(i))).inverse();
    scene.position_noise_m = 0.2;
    scene.yaw_noise_rad = 0.06;
    const Pose T_world_cam = scene.D.inverse() * Pose::Trans(middle);
    const auto left = [&](const Pose& T) { return (T.translation() - middle).norm() / kScenes; };
    EXPECT_NEAR(left(T_world_cam) * kScenes, 3.17, 1e-9);

    const std::vector<DriftPair> pairs = scene.Pairs(random);
    sum.printed += left(SolveDriftAsPrinted(pairs)->inverse() * T_world_cam);
    // the obvious repair: T_wo_l T_wo_g^-1 in place of T_wo_l^-1 T_wo_g
    std::vector<DriftPair> swapped = pairs;
    for (DriftPair& pair : swapped) {
      pair.T_world_local = pair.T_world_local.inverse();
      pair.T_world_global = pair.T_world_global.inverse();
    }
    sum.repaired += left(SolveDriftAsPrinted(swapped)->inverse() * T_world_cam);
    sum.ours += left(SolveDrift(pairs, scene.gravity(), FourDof()).T_global_local * T_world_cam);
    scene.flipped = 0.2;
    const DriftResult flipped = SolveDrift(scene.Pairs(random), scene.gravity(), FourDof());
    sum.ours_flipped += left(flipped.T_global_local * T_world_cam);
  }
  for (const auto& [name, value] : {std::pair<const char*, double>{"printed_m", sum.printed},
                                    {"repaired_m", sum.repaired},
                                    {"ours_m", sum.ours},
                                    {"ours_flipped_m", sum.ours_flipped}})
    testing::Test::RecordProperty(name, std::to_string(value));
  return sum;
}

TEST(Drift, AtTheOriginThePrintedResidualLeavesItAllAndOursNothing) {
  const Leftover left = CorrectDrift(Vec3(0, 0, 0));
  EXPECT_NEAR(left.printed, 3.17, 0.2) << "the printed residual lives in the objects' frames";
  EXPECT_LT(left.repaired, 0.5);
  EXPECT_LT(left.ours, 0.15);
  EXPECT_LT(left.ours_flipped, 0.15);
}

TEST(Drift, FarFromTheOriginTheObviousRepairMakesItWorse) {
  const Leftover left = CorrectDrift(Vec3(180, 0, 240));
  EXPECT_GT(left.printed, 3.);
  EXPECT_GT(left.repaired, 3.17) << "its lever arm reaches to the origin";
  EXPECT_LT(left.repaired, 20.);
  EXPECT_LT(left.ours, 0.15);
  EXPECT_LT(left.ours_flipped, 0.15);
}

TEST(Drift, FlippedHeadingsAndAStrayPairDoNoHarm) {
  Random random(3);
  Scene scene;
  scene.D = TurnAndShift(scene.up, 0.4, Vec3(0, 0, 0), Vec3(5, 0.2, -3));
  scene.flipped = 0.4;
  std::vector<DriftPair> pairs = scene.Pairs(random);
  pairs[3].T_world_global.translation() += Vec3(20, 0, 10);
  const DriftResult result = SolveDrift(pairs, scene.gravity(), FourDof());
  ASSERT_TRUE(result.usable) << result.reason;
  EXPECT_LT(Difference(result.T_global_local, scene.D), 0.01);
  EXPECT_EQ(result.inliers, scene.objects - 1);
  EXPECT_LT(result.rms_m, 0.02);
}

TEST(Drift, FourDofLeavesTheVerticalAlone) {
  Random random(5);
  Scene scene;
  scene.position_noise_m = 0.5;
  const DriftResult result = SolveDrift(scene.Pairs(random), scene.gravity(), FourDof());
  ASSERT_TRUE(result.usable);
  EXPECT_LT((result.T_global_local.so3() * kKittiUp - kKittiUp).norm(), 1e-12);
}

TEST(Drift, SymmetryIsRespected) {
  const std::vector<Vec3> corners = {{0, 0, 0}, {8, 0, 0}, {0, 5, 0}};
  for (const Symmetry symmetry : {Symmetry::kPi, Symmetry::kFull}) {
    std::vector<DriftPair> pairs;
    for (const Vec3& p : corners) {
      const double turn = symmetry == Symmetry::kPi ? M_PI : 1.234;
      pairs.push_back(At(p, p + Vec3(1, 2, 3), 0.3, 0.3 + turn, symmetry));
    }
    const DriftResult result = Solve(pairs);
    ASSERT_TRUE(result.usable) << result.reason;
    EXPECT_LT(Difference(result.T_global_local, Pose::Trans(1, 2, 3)), 1e-9);
  }
}

TEST(Drift, OneObject) {
  const DriftResult car = Solve({At({1, 2, 0}, {4, 6, 0}, 0.1, 0.6, Symmetry::kNone)});
  ASSERT_TRUE(car.usable) << car.reason;
  EXPECT_NEAR(car.T_global_local.so3().Log().z(), 0.5, 1e-9);
  EXPECT_LT((car.T_global_local * Vec3(1, 2, 0) - Vec3(4, 6, 0)).norm(), 1e-9);
  EXPECT_NEAR(car.covariance(5, 5), 0.01, 1e-6);

  const DriftResult box = Solve({At({1, 2, 0}, {4, 6, 0}, 0.1, 0.6, Symmetry::kPi)});
  EXPECT_FALSE(box.usable);
  EXPECT_NE(box.reason.find("half a turn"), std::string::npos);
  const DriftResult pole = Solve({At({1, 2, 0}, {4, 6, 0}, kNaN, 0.6, Symmetry::kNone)});
  EXPECT_FALSE(pole.usable);
  EXPECT_NE(pole.reason.find("nothing fixes the yaw"), std::string::npos);
}

TEST(Drift, TwoPolesAndACollinearRow) {
  std::vector<DriftPair> pairs;
  const Pose D = TurnAndShift(Vec3::UnitZ(), 2., Vec3(0, 0, 0), Vec3(1, 1, 0));
  for (int i = 0; i < 6; ++i) {
    const Vec3 p(7. * i, 0, 0);
    pairs.push_back(At(p, D * p, kNaN, kNaN, Symmetry::kFull));
    const DriftResult result = Solve(pairs);
    ASSERT_EQ(result.usable, i > 0) << result.reason;
    if (!result.usable) continue;
    EXPECT_LT(Difference(result.T_global_local, D), 1e-6);
    DriftOptions six_dof = FourDof();  // the turn about the row's own axis is left to the prior
    six_dof.six_dof = true;
    const DriftResult six = SolveDrift(pairs, GravityFrame::FromUp(Vec3::UnitZ()), six_dof);
    ASSERT_TRUE(six.usable) << six.reason;
    EXPECT_LT(Difference(six.T_global_local, D), 1e-6);
  }
}

TEST(Drift, AllOnOneSpot) {
  std::vector<DriftPair> poles(5, At({3, 3, 0}, {4, 4, 0}, kNaN, kNaN, Symmetry::kFull));
  EXPECT_FALSE(Solve(poles).usable);
  std::vector<DriftPair> cars(5, At({3, 3, 0}, {4, 4, 0}, 0., 1., Symmetry::kNone));
  const DriftResult result = Solve(cars);
  ASSERT_TRUE(result.usable) << result.reason;
  EXPECT_NEAR(result.T_global_local.so3().Log().z(), 1., 1e-9);
  // Many local ones taken for a single global one: the local positions say nothing about the yaw
  // either.
  std::vector<DriftPair> many_to_one;
  for (int i = 0; i < 5; ++i)
    many_to_one.push_back(At({10. * i, 0, 0}, {4, 4, 0}, kNaN, kNaN, Symmetry::kFull));
  EXPECT_FALSE(Solve(many_to_one).usable);
}

TEST(Drift, BadInputIsRefusedWithTheReason) {
  EXPECT_FALSE(Solve({}).usable);
  EXPECT_EQ(Solve({}).reason, "no matched objects");
  const DriftPair good = At({1, 2, 0}, {4, 6, 0}, 0.1, 0.6, Symmetry::kNone);
  DriftPair bad = good;
  bad.T_world_global.translation().x() = kNaN;
  EXPECT_EQ(Solve({good, bad}).reason, "a matched object's pose is not finite");
  EXPECT_FALSE(SolveDriftAsPrinted({good, bad}));
  bad = good;
  bad.T_world_local.data()[0] = kNaN;
  EXPECT_FALSE(Solve({good, bad}).usable);
  EXPECT_FALSE(SolveDriftAsPrinted({good, bad}));
  for (const double sigma : {0., -1., kNaN, std::numeric_limits<double>::infinity()}) {
    bad = good;
    bad.sigma_yaw_rad = sigma;
    EXPECT_EQ(Solve({good, bad}).reason, "a matched object's sigma is not positive");
  }
  bad = good;
  bad.sigma_horizontal_m = 1e-200;  // its square is 0
  EXPECT_FALSE(Solve({good, bad}).usable);
}

TEST(Drift, ContradictingHeadingsOnOneSpotAreRefused) {
  std::vector<DriftPair> pairs;
  for (int i = 0; i < 8; ++i)
    pairs.push_back(At({0, 0, 0}, {0, 0, 0}, 0., i * M_PI / 4, Symmetry::kNone));
  const DriftResult result = Solve(pairs);
  EXPECT_FALSE(result.usable);
  EXPECT_NE(result.reason.find("contradict"), std::string::npos) << result.reason;
  EXPECT_TRUE(Solve({pairs[0], pairs[0], pairs[3]}).usable) << "two of three agree";
}

TEST(Drift, HalfOfTheHeadingsIsNotMost) {
  const DriftPair ahead = At({0, 0, 0}, {0, 0, 0}, 0., 0., Symmetry::kNone),
                  left = At({0, 0, 0}, {0, 0, 0}, 0., M_PI / 2, Symmetry::kNone);
  const DriftResult result = Solve({ahead, left});
  EXPECT_FALSE(result.usable);
  EXPECT_NE(result.reason.find("contradict"), std::string::npos) << result.reason;
  EXPECT_FALSE(Solve({ahead, left, ahead, left}).usable);
  EXPECT_TRUE(Solve({ahead, left, ahead}).usable);
}

TEST(DriftAsPrinted, IsAMinimumOfTheEquationAsPrinted) {
  Random random(2);
  Scene scene;
  scene.position_noise_m = 0.3;
  scene.yaw_noise_rad = 0.1;
  scene.D = TurnAndShift(scene.up, 0.1, Vec3(0, 0, 0), Vec3(1, 0, 2));
  const std::vector<DriftPair> pairs = scene.Pairs(random);
  const auto cost = [&](const Pose& T_drift) {
    double sum = 0;
    for (const DriftPair& pair : pairs)
      sum += (T_drift.inverse() * (pair.T_world_local.inverse() * pair.T_world_global))
                 .Log()
                 .squaredNorm();
    return sum;
  };
  EXPECT_FALSE(SolveDriftAsPrinted({}));
  const std::optional<Pose> T_drift = SolveDriftAsPrinted(pairs);
  ASSERT_TRUE(T_drift);
  for (int i = 0; i < 6; ++i) {
    for (const double step : {-1e-3, 1e-3}) {
      Pose::Tangent d = Pose::Tangent::Zero();
      d[i] = step;
      EXPECT_GT(cost(*T_drift * Pose::Exp(d)), cost(*T_drift));
    }
  }
}

}  // namespace
}  // namespace sslcd
