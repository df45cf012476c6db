// SPDX-License-Identifier: BSD-3-Clause
#include "bundle/object_ba.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace sslcd {
namespace {

struct Truth {
  std::vector<Pose> cameras;
  std::vector<UprightPose> objects;
};

// A camera drives 1 m a frame past parked cars; odometry is `stretch` times too long; `sigma`
// scales detection noise.
BaProblem Street(int frames, double stretch, double sigma, Truth& truth, unsigned seed = 1) {
  std::mt19937 random(seed);
  const auto gauss = [&] {
    double sum = -6;
    for (int i = 0; i < 12; ++i) sum += (random() % 100000) / 100000.;
    return sum;
  };
  BaProblem problem;
  for (int i = 0; i < frames; ++i) {
    truth.cameras.push_back(Pose::Trans(0, 0, i) * Pose::RotY(0.02 * std::sin(0.3 * i)));
    problem.cameras.push_back(
        {i, Pose(truth.cameras[i].so3(), truth.cameras[i].translation() * stretch)});
    if (i == 0) continue;
    Pose step = truth.cameras[i - 1].inverse() * truth.cameras[i];
    step.translation() *= stretch;
    problem.odometry.push_back({i - 1, i, step});
  }
  for (int k = 0; k < frames / 2; ++k) {
    truth.objects.push_back({Vec3(k % 2 ? 5 : -5, 1, 10. + 2 * k), 1.5});
    problem.objects.push_back(
        {100 + k, Symmetry::kNone, {truth.objects[k].position * stretch, 1.4}});
    for (int i = 0; i < frames; ++i) {
      Pose seen = truth.cameras[i].inverse() * ToPose(truth.objects[k], problem.gravity);
      if (seen.translation().z() < 3 || seen.translation().z() > 25) continue;
      const DetectionSigmas s =
          SigmasAt(seen.translation().norm(), problem.noise, problem.noise_scale);
      const Vec3 error(s.radial * gauss(), s.lateral * gauss(), s.vertical * gauss());
      seen.translation() += sigma * RayFrame(seen.translation()).transpose() * error;
      seen.so3() = seen.so3() * lie::SO3<double>::RotZ(sigma * s.yaw * gauss());
      problem.sightings.push_back({i, k, seen});
    }
  }
  return problem;
}

double WorstCamera(const BaProblem& problem, const Truth& truth) {
  double worst = 0;
  for (std::size_t i = 0; i < truth.cameras.size(); ++i)
    worst = std::max(
        worst,
        (problem.cameras[i].T_world_cam.translation() - truth.cameras[i].translation()).norm());
  return worst;
}

TEST(SolveBa, FindsTheScaleFromTheCarsAlone) {
  Truth truth;
  BaProblem problem = Street(40, 1.03, 1., truth);
  const BaSummary summary = SolveBa(problem, {});
  ASSERT_TRUE(summary.usable) << summary.message;
  EXPECT_NEAR(std::exp(problem.log_scale), 1 / 1.03, 0.005);
  EXPECT_LT(WorstCamera(problem, truth), 0.25);
  for (std::size_t k = 0; k < truth.objects.size(); ++k)
    EXPECT_LT((problem.objects[k].pose.position - truth.objects[k].position).norm(), 0.3);
}

TEST(SolveBa, NoiseThatGrowsWithRangeDoesNotPullAnObjectNearer) {
  BaProblem problem;
  problem.noise.radial_m = 0.01;
  problem.noise.radial_per_m = 0.08;
  problem.cameras.push_back({0, Pose()});
  problem.objects.push_back({1, Symmetry::kFull, {Vec3(0, 0, 20), 0}});
  for (int i = 0; i < 20; ++i)
    problem.sightings.push_back({0, 0, Pose::Trans(0, 0, i % 2 == 0 ? 18 : 22)});
  BaOptions options;
  options.loss_scale = 0;
  ASSERT_TRUE(SolveBa(problem, options).usable);
  EXPECT_NEAR(problem.objects[0].pose.position.z(), 20, 0.01);
}

TEST(SolveBa, ErrorsAlongAndAcrossTheRayDoNotPullAnObjectNearer) {
  BaProblem problem;
  problem.cameras.push_back({0, Pose()});
  problem.objects.push_back({1, Symmetry::kFull, {Vec3(0, 0, 20), 0}});
  for (const double across : {-1., 1.})
    for (const double along : {-3., 3.})
      problem.sightings.push_back({0, 0, Pose::Trans(across, 0, 20 + along)});
  BaOptions options;
  options.loss_scale = 0;
  ASSERT_TRUE(SolveBa(problem, options).usable);
  EXPECT_NEAR(problem.objects[0].pose.position.z(), 20, 0.01);
}

TEST(SolveBa, WithoutNoiseEverySolverReachesTheTruth) {
  for (const auto residual : {BaOptions::Residual::kRobust, BaOptions::Residual::kPaper}) {
    for (const auto solver :
         {BaOptions::Solver::kLevenbergMarquardt, BaOptions::Solver::kGaussNewton}) {
      Truth truth;
      BaProblem problem = Street(20, 1., 0., truth);
      BaOptions options;
      options.residual = residual;
      options.solver = solver;
      options.loss_scale = 0;
      ASSERT_TRUE(SolveBa(problem, options).usable);
      EXPECT_LT(WorstCamera(problem, truth), 1e-3);
      EXPECT_NEAR(problem.objects[3].pose.yaw, 1.5, 1e-3);
    }
  }
}

TEST(SolveBa, HalfTurnsAndOutliersDoNoHarm) {
  Truth truth;
  BaProblem problem = Street(40, 1.03, 1., truth);
  for (std::size_t i = 0; i < problem.sightings.size(); i += 9)
    problem.sightings[i].T_cam_object.so3() =
        problem.sightings[i].T_cam_object.so3() * lie::SO3<double>::RotZ(M_PI);
  for (std::size_t i = 4; i < problem.sightings.size(); i += 31)
    problem.sightings[i].T_cam_object.translation() += Vec3(3, 0, -4);
  ASSERT_TRUE(SolveBa(problem, {}).usable);
  EXPECT_LT(WorstCamera(problem, truth), 0.4);
  for (const BaObject& object : problem.objects) EXPECT_NEAR(object.pose.yaw, 1.5, 0.1);
}

// The cameras follow the odometry, and but for one sighting there is nothing else.
void OnlyOdometry(BaProblem& problem) {
  problem.sightings = {problem.sightings.front()};
  problem.objects = {problem.objects[problem.sightings[0].object]};
  problem.sightings[0].object = 0;
  for (std::size_t i = 1; i < problem.cameras.size(); ++i)
    problem.cameras[i].T_world_cam =
        problem.cameras[i - 1].T_world_cam * problem.odometry[i - 1].T_from_to;
}

TEST(SolveBa, OnTheGroundAPitchingOdometryDoesNotClimb) {
  const auto highest = [](const SlopePrior& slope) {
    Truth truth;
    BaProblem problem = Street(200, 1, 1, truth);
    for (BaOdometry& edge : problem.odometry) edge.T_from_to = edge.T_from_to * Pose::RotX(5e-4);
    OnlyOdometry(problem);
    EXPECT_GT(std::abs(problem.cameras.back().T_world_cam.translation().y()), 9);
    problem.slope = slope;
    BaOptions options;
    options.odometry.rotation_walk = 5e-3;
    EXPECT_TRUE(SolveBa(problem, options).usable);
    return std::abs(problem.cameras.back().T_world_cam.translation().y());
  };
  const double as_before = highest({}), level = highest({0.05, 20});
  EXPECT_LT(level, 0.4 * as_before);
}

TEST(SolveBa, SlopesAreThoseOfThePathInMetres) {
  Truth truth;
  BaProblem metric = Street(100, 1, 0, truth);
  for (BaOdometry& edge : metric.odometry) edge.T_from_to = edge.T_from_to * Pose::RotX(1e-3);
  OnlyOdometry(metric);
  metric.slope = {0.05, 20};
  BaProblem halved = metric;
  for (BaOdometry& edge : halved.odometry) edge.T_from_to.translation() /= 2;
  halved.log_scale = std::log(2.);
  BaOptions options;
  options.odometry.scale_prior = 0;  // known
  options.odometry.translation_walk = options.odometry.vertical_walk =
      options.odometry.rotation_walk = 0;
  options.odometry.rotation_floor_rad = 5e-3;
  const double before = std::abs(metric.cameras.back().T_world_cam.translation().y());
  ASSERT_TRUE(SolveBa(metric, options).usable);
  ASSERT_TRUE(SolveBa(halved, options).usable);
  const double after = metric.cameras.back().T_world_cam.translation().y();
  EXPECT_LT(std::abs(after), 0.9 * before);
  EXPECT_NEAR(halved.cameras.back().T_world_cam.translation().y(), after, 0.01 * std::abs(after));
}

TEST(SolveBa, AHillStaysWhereTheOdometryIsGood) {
  Truth truth;
  BaProblem problem = Street(200, 1, 0, truth);
  for (std::size_t i = 0; i < problem.odometry.size(); ++i)  // up by 3 degrees and down again
    if (i == 50 || i == 149)
      problem.odometry[i].T_from_to = problem.odometry[i].T_from_to * Pose::RotX(0.05);
    else if (i == 99)
      problem.odometry[i].T_from_to = problem.odometry[i].T_from_to * Pose::RotX(-0.1);
  OnlyOdometry(problem);
  const double top = problem.cameras[100].T_world_cam.translation().y();
  EXPECT_GT(std::abs(top), 2);
  problem.slope = {0.05, 200};
  EXPECT_TRUE(SolveBa(problem, {}).usable);
  EXPECT_NEAR(problem.cameras[100].T_world_cam.translation().y(), top, 0.1 * std::abs(top));
}

TEST(SolveBa, TiesHoldWhatTheyMeasureAndWrongOnesLittle) {
  BaOptions options;
  options.odometry.translation_walk = 0.03;
  options.odometry.rotation_walk = 5e-3;
  for (const bool wrong : {false, true}) {
    Truth truth;
    BaProblem problem = Street(40, 1., 1., truth);
    // The odometry rotates, and no object contradicts it.
    for (BaOdometry& edge : problem.odometry) edge.T_from_to = edge.T_from_to * Pose::RotY(3e-3);
    for (std::size_t i = 1; i < problem.cameras.size(); ++i)
      problem.cameras[i].T_world_cam =
          problem.cameras[i - 1].T_world_cam * problem.odometry[i - 1].T_from_to;
    problem.sightings.resize(1);
    BaProblem tied = problem;
    const Pose::Matrix6 covariance = 1e-4 * Pose::Matrix6::Identity();
    for (const int to : {20, 30, 35, 38, 39})
      tied.ties.push_back({0, to, {truth.cameras[0].inverse() * truth.cameras[to], covariance}});
    if (wrong) tied.ties[0].pose.T_a_b = tied.ties[0].pose.T_a_b * Pose::Trans(3, 0, 0);
    ASSERT_TRUE(SolveBa(problem, options).usable);
    ASSERT_TRUE(SolveBa(tied, options).usable);
    EXPECT_GT(WorstCamera(problem, truth), 0.5);
    EXPECT_LT(WorstCamera(tied, truth), wrong ? 0.2 : 0.1);
  }
}

TEST(SolveBa, ATieIsAsGoodInEachDirectionAsItsCovarianceSaysInTheSecondCamerasAxes) {
  const Pose T_from_to = Pose::Trans(3, 0, 1) * Pose::RotY(M_PI / 2);
  BaProblem problem;
  problem.cameras = {{0, Pose()}, {1, T_from_to * Pose::Trans(0.05, 0, 0.05)}};
  // One camera has a known x, the other one a known z.
  Pose::Matrix6 along_x = 1e-6 * Pose::Matrix6::Identity(), along_z = along_x;
  along_x(2, 2) = along_z(0, 0) = 1;
  problem.ties.push_back({0, 1, {T_from_to * Pose::Trans(0, 0, 0.2), along_x}});
  problem.ties.push_back({0, 1, {T_from_to * Pose::Trans(0.2, 0, 0), along_z}});
  ASSERT_TRUE(SolveBa(problem, {}).usable);
  const Pose& solved = problem.cameras[1].T_world_cam;
  EXPECT_LT((solved.translation() - T_from_to.translation()).norm(), 1e-3);
  EXPECT_LT((T_from_to.so3().inverse() * solved.so3()).Log().norm(), 1e-3);
}

TEST(SolveBa, IsDeterministic) {
  Truth truth;
  BaProblem a = Street(30, 1.03, 1., truth), b = a;
  SolveBa(a, {});
  SolveBa(b, {});
  for (std::size_t i = 0; i < a.cameras.size(); ++i)
    EXPECT_TRUE(std::equal(a.cameras[i].T_world_cam.data(), a.cameras[i].T_world_cam.data() + 7,
                           b.cameras[i].T_world_cam.data()));
}

TEST(SolveBa, LeavesBadProblemsAlone) {
  Truth truth;
  BaProblem empty;
  EXPECT_FALSE(SolveBa(empty, {}).usable);
  BaProblem nan = Street(10, 1., 0., truth);
  nan.sightings[0].T_cam_object.translation().x() = std::numeric_limits<double>::quiet_NaN();
  const BaProblem before = nan;
  const BaSummary summary = SolveBa(nan, {});
  EXPECT_FALSE(summary.usable);
  EXPECT_NE(summary.message.find("NaN"), std::string::npos);
  EXPECT_EQ(nan.log_scale, before.log_scale);
}

TEST(SolveBa, ATreeKeepsItsYaw) {
  Truth truth;
  BaProblem problem = Street(20, 1., 1., truth);
  for (BaObject& object : problem.objects) object.symmetry = Symmetry::kFull;
  ASSERT_TRUE(SolveBa(problem, {}).usable);
  for (const BaObject& object : problem.objects) EXPECT_EQ(object.pose.yaw, 1.4);
}

TEST(Marginalise, TheWindowKeepsWhatItKnew) {
  // Solving everything at once and solving with the first half marginalised must agree where both
  // speak.
  Truth truth;
  BaProblem full = Street(20, 1.03, 0.2, truth);
  BaOptions options;
  options.loss_scale = 0;  // linearised exactly where the full solution is
  options.max_iterations = 100;
  SolveBa(full, options);

  std::vector<int> cameras, objects;
  for (int i = 0; i < 10; ++i) cameras.push_back(i);
  for (int k = 0; k < static_cast<int>(full.objects.size()); ++k) {
    bool later = false;
    for (const BaSighting& s : full.sightings) later |= s.object == k && s.camera >= 10;
    if (!later) objects.push_back(k);
  }
  const BaPrior prior = Marginalise(full, cameras, objects, options);
  ASSERT_FALSE(prior.empty());
  EXPECT_EQ(prior.frames, std::vector<int>{10})
      << "odometry ties the dropped cameras to the next one only";

  BaProblem window = full;
  window.prior = prior;
  window.cameras.erase(window.cameras.begin(), window.cameras.begin() + 10);
  window.odometry.clear();
  window.sightings.clear();
  for (const BaOdometry& edge : full.odometry)
    if (edge.from >= 10) window.odometry.push_back({edge.from - 10, edge.to - 10, edge.T_from_to});
  std::vector<int> new_index(full.objects.size(), -1);
  window.objects.clear();
  for (int k = 0; k < static_cast<int>(full.objects.size()); ++k) {
    if (std::find(objects.begin(), objects.end(), k) != objects.end()) continue;
    new_index[k] = static_cast<int>(window.objects.size());
    window.objects.push_back(full.objects[k]);
  }
  for (const BaSighting& s : full.sightings)
    if (s.camera >= 10)
      window.sightings.push_back({s.camera - 10, new_index[s.object], s.T_cam_object});
  // start somewhere else
  for (BaObject& object : window.objects) object.pose.position += Vec3(0.05, 0, -0.05);
  ASSERT_TRUE(SolveBa(window, options).usable);
  for (int i = 10; i < 20; ++i)
    EXPECT_LT((window.cameras[i - 10].T_world_cam.translation() -
               full.cameras[i].T_world_cam.translation())
                  .norm(),
              3e-3);
  EXPECT_NEAR(window.log_scale, full.log_scale, 2e-4);
}

TEST(EstimateNoiseScale, MeasuresTheScatter) {
  Truth truth;
  BaProblem problem = Street(60, 1., 3., truth);
  SolveBa(problem, {});
  const NoiseScale scale = EstimateNoiseScale(problem);
  EXPECT_NEAR(scale.radial, 3., 0.7);
  EXPECT_NEAR(scale.lateral, 3., 0.8);
  EXPECT_NEAR(scale.yaw, 3., 0.7);
}

}  // namespace
}  // namespace sslcd
