// SPDX-License-Identifier: BSD-3-Clause
// The trajectory errors against evo itself.
#include <gtest/gtest.h>

#include <map>
#include <random>

#include "outside.h"
#include "sslcd/eval/trajectory_error.h"

namespace sslcd {
namespace {

using outside::Quoted;

constexpr double kTolerance = 1e-6;

std::map<std::string, double> AskEvo(const Trajectory& est, const Trajectory& ref,
                                     double max_difference_s) {
  const outside::TempDir folder;
  const auto est_file =
      outside::WriteFile(folder.path() / "est.txt", outside::TumText(est.stamps, est.poses));
  const auto ref_file =
      outside::WriteFile(folder.path() / "ref.txt", outside::TumText(ref.stamps, ref.poses));
  const auto script = outside::SourceDir() / "tests/eval/evo_reference.py";
  const outside::CommandResult run =
      outside::RunCommand("python3 " + Quoted(script) + " " + Quoted(est_file) + " " +
                          Quoted(ref_file) + " " + std::to_string(max_difference_s));
  EXPECT_EQ(run.status, 0) << run.output;
  std::map<std::string, double> answers;
  std::istringstream rows(run.output);
  std::string key;
  for (double value; rows >> key >> value;) answers[key] = value;
  return answers;
}

void ExpectEqual(const ErrorStats& ours, std::map<std::string, double>& evo,
                 const std::string& key) {
  ASSERT_TRUE(evo.count(key + ".rmse")) << key;
  EXPECT_EQ(ours.count, evo[key + ".count"]) << key;
  EXPECT_NEAR(ours.rmse, evo[key + ".rmse"], kTolerance) << key;
  EXPECT_NEAR(ours.mean, evo[key + ".mean"], kTolerance) << key;
  EXPECT_NEAR(ours.median, evo[key + ".median"], kTolerance) << key;
  EXPECT_NEAR(ours.std, evo[key + ".std"], kTolerance) << key;
  EXPECT_NEAR(ours.max, evo[key + ".max"], kTolerance) << key;
}

void ExpectAgreement(const Trajectory& est, const Trajectory& ref, double max_difference_s) {
  std::map<std::string, double> evo = AskEvo(est, ref, max_difference_s);
  const MatchedPoses matched = MatchByStamp(est, ref, max_difference_s);

  for (const Alignment alignment : {Alignment::kNone, Alignment::kSe3, Alignment::kSim3}) {
    const AteResult ate = ComputeAte(matched.est, matched.ref, alignment);
    ExpectEqual(ate.error, evo, ToString(alignment));
    EXPECT_TRUE(ate.unique);
    if (alignment != Alignment::kSim3) continue;
    EXPECT_NEAR(ate.S_ref_est.scale, evo["sim3.scale"], 1e-9);
  }
  const AteResult yaw_only = ComputeAte(matched.est, matched.ref, Alignment::k4Dof);
  EXPECT_NEAR(yaw_only.error.rmse, evo["4dof.rmse"], kTolerance);

  struct Case {
    const char* name;
    RpeOptions options;
  };
  for (const Case& c : {Case{"rpe1f", {1, DeltaUnit::kFrames, false}},
                        Case{"rpe7f", {7, DeltaUnit::kFrames, false}},
                        Case{"rpe7fall", {7, DeltaUnit::kFrames, true}},
                        Case{"rpe5m", {5, DeltaUnit::kMetres, false}},
                        Case{"rpe5mall", {5, DeltaUnit::kMetres, true}}}) {
    const RpeResult rpe = ComputeRpe(matched.est, matched.ref, c.options);
    ExpectEqual(rpe.translation, evo, std::string(c.name) + ".translation_part");
    ExpectEqual(rpe.rotation_rad, evo, std::string(c.name) + ".rotation_angle_rad");
  }
}

class EvoAgreement : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!outside::PythonHas("evo, scipy"))
      GTEST_SKIP() << "skipped: python3 with evo and scipy is not installed";
  }
};

/// A winding path, and the same seen by an odometry that drifts, is off in scale and starts
/// elsewhere.
TEST_F(EvoAgreement, SyntheticDriftingPathWithStampsThatDoNotMeet) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  Trajectory ref, est;
  Pose T_ref, T_est = Pose(lie::SO3<double>::Exp(Vec3(0.2, -1.1, 0.3)), Vec3(30, -4, 12));
  for (int i = 0; i < 240; ++i) {
    Vec6 step, noise;
    step << 0.02, 0.01 * std::sin(0.1 * i), 0.6, 0.002, 0.03 * std::sin(0.05 * i), 0.001;
    for (double& x : noise) x = 0.01 * normal(random);
    T_ref *= Pose::Exp(step);
    Vec6 seen = step + noise;
    seen.head<3>() *= 1.04;
    T_est *= Pose::Exp(seen);
    ref.stamps.push_back(0.1 * i);
    ref.poses.push_back(T_ref);
    if (i % 3 == 1) continue;  // the estimate has fewer poses, at slightly other times
    est.stamps.push_back(0.1 * i + 0.012 * normal(random));
    est.poses.push_back(T_est);
  }
  ExpectAgreement(est, ref, 0.02);
  ExpectAgreement(ref, est, 0.02);
}

TEST_F(EvoAgreement, RealOdometryAgainstOxts) {
  const auto folder = outside::DataDir() / "kitti-tracking";
  if (!outside::fs::exists(folder)) GTEST_SKIP() << "skipped: no data";
  Trajectory est, ref;
  est.poses = outside::ReadKittiPoses(folder / "orbslam3_poses/0007.txt");
  ref.poses = outside::ReadKittiPoses(folder / "oxts_cam0_poses/0007.txt");
  for (Trajectory* t : {&est, &ref}) {
    for (std::size_t i = 0; i < t->size(); ++i) t->stamps.push_back(0.1 * static_cast<double>(i));
  }
  ExpectAgreement(est, ref, 0.01);
  // as in the data's notes
  EXPECT_NEAR(ComputeAte(est.poses, ref.poses, Alignment::kSe3).error.rmse, 3.33, 0.005);
  EXPECT_NEAR(ComputeAte(est.poses, ref.poses, Alignment::kSim3).error.rmse, 1.02, 0.005);
}

}  // namespace
}  // namespace sslcd
