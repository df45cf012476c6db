// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/bundle.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <random>

#include "stereo/tunnel.h"

namespace sslcd {
namespace {

/// Points in front of frames that move on by a step each, seen without noise.
struct Scene {
  StereoCamera camera = Tunnel::Camera();
  OdometryPoints points;
  std::vector<StereoFrame> frames;

  Scene(int seed, int n_frames, int n_points) {
    std::mt19937 random(seed);
    const auto uniform = [&](double a, double b) { return a + (b - a) * random() / 4294967296.0; };
    for (int i = 0; i < n_points; ++i)
      points[i] = Vec3(uniform(-5, 5), uniform(-3, 3), uniform(5, 20));
    for (int f = 0; f < n_frames; ++f) {
      StereoFrame frame{Pose::Trans(0.05 * f, 0, 0.4 * f) * Pose::RotY(0.03 * f), {}};
      for (const auto& [id, point] : points) {
        const StereoPixel p = ProjectStereo(camera, frame.T_odom_left.inverse() * point);
        frame.sightings.push_back({id, p});
      }
      frames.push_back(frame);
    }
  }
};

double Off(const Pose& a, const Pose& b) { return (a.inverse() * b).Log().norm(); }

TEST(OdometryWindow, TriangulateUndoesProject) {
  StereoCamera camera = Tunnel::Camera();
  camera.disparity_at_infinity = 0.7;
  const Vec3 point(1, -2, 7);
  EXPECT_LT((Triangulate(camera, ProjectStereo(camera, point)) - point).norm(), 1e-12);
}

TEST(OdometryWindow, RefinePoseFindsTheExactPoseInSpiteOfOutliers) {
  Scene scene(1, 2, 60);
  const Pose truth = scene.frames[1].T_odom_left;
  scene.frames[1].T_odom_left =
      truth * Pose::Exp((Vec6() << .05, -.03, .04, .01, -.01, .02).finished());
  for (int i = 0; i < 6; ++i) scene.frames[1].sightings[i].pixel.left += 40;
  for (int i = 6; i < 20; ++i) scene.frames[1].sightings[i].pixel.right = NAN;  // not seen there
  RefinePose(scene.camera, scene.points, 0.15, scene.frames[1]);
  EXPECT_LT(Off(scene.frames[1].T_odom_left, truth), 1e-4);
}

TEST(OdometryWindow, RefinePoseLeavesAFrameWithoutPointsAlone) {
  Scene scene(1, 1, 0);
  RefinePose(scene.camera, scene.points, 1, scene.frames[0]);
  EXPECT_EQ(Off(scene.frames[0].T_odom_left, Pose()), 0);
}

TEST(OdometryWindow, RefineWindowMovesPosesAndPointsToWhereTheyWere) {
  const Scene truth(2, 5, 80);
  Scene scene = truth;
  for (int f = 1; f < 5; ++f)
    scene.frames[f].T_odom_left *=
        Pose::Exp((Vec6() << .02 * f, -.01, .03, .004, -.003, .002 * f).finished());
  for (auto& [id, point] : scene.points) point *= 1 + 0.01 * (id % 5 - 2);
  scene.points[1000] = Vec3(0, 0, 9);  // seen once: stays
  scene.frames[2].sightings.push_back({1000, {160, 120, 150}});
  std::vector<StereoFrame*> frames;
  for (StereoFrame& frame : scene.frames) frames.push_back(&frame);
  RefineWindow(scene.camera, 1, frames, 1, scene.points);
  EXPECT_EQ(Off(scene.frames[0].T_odom_left, Pose()), 0);
  for (int f = 1; f < 5; ++f)
    EXPECT_LT(Off(scene.frames[f].T_odom_left, truth.frames[f].T_odom_left), 1e-3) << f;
  for (const auto& [id, point] : truth.points)
    EXPECT_LT((scene.points[id] - point).norm(), 0.01) << id;
  EXPECT_EQ(scene.points[1000], Vec3(0, 0, 9));
}

TEST(OdometryWindow, RefineWindowCalibrates) {
  Scene scene(2, 5, 80);
  scene.camera.disparity_at_infinity = 0.4;  // it was 0
  for (const StereoSighting& s : scene.frames[0].sightings)
    scene.points[s.point] = Triangulate(scene.camera, s.pixel);
  std::vector<StereoFrame*> frames;
  for (StereoFrame& frame : scene.frames) {
    frames.push_back(&frame);
    for (StereoSighting& s : frame.sightings) s.weight << 1, 0, 0, 0, 2, 0, 3, 0, -3;
  }
  EXPECT_EQ(RefineWindow(scene.camera, 1, frames, 1, scene.points), 0.4) << "not asked for";
  EXPECT_NEAR(RefineWindow(scene.camera, 1, frames, 1, scene.points, true), 0, 1e-3);
  EXPECT_LT(Off(scene.frames[4].T_odom_left, Scene(2, 5, 80).frames[4].T_odom_left), 1e-3)
      << "to scale again";
}

// Left columns are off, and right ones with them: where only that is noise, rows and disparities
// tell the pose.
TEST(OdometryWindow, WeightsSayWhatIsWorthHow) {
  Eigen::Matrix3d weight;
  weight << 1, 0, 0, 0, 100, 0, 100, 0, -100;
  double off[2];
  for (const bool weighted : {false, true}) {
    Scene scene(1, 2, 60);
    std::mt19937 random(1);
    std::normal_distribution<double> gauss(0, 1);
    for (StereoSighting& s : scene.frames[1].sightings) {
      const double error = gauss(random);
      s.pixel.left += error;
      s.pixel.right += error;
      if (weighted) s.weight = weight;
      if (s.point % 5 == 0) s.pixel.right = NAN;  // then the third row says nothing
    }
    const Pose truth = scene.frames[1].T_odom_left;
    scene.frames[1].T_odom_left = truth * Pose::Trans(0.1, 0.05, 0.2) * Pose::RotY(0.02);
    RefinePose(scene.camera, scene.points, 3, scene.frames[1]);
    off[weighted] = Off(truth, scene.frames[1].T_odom_left);
  }
  EXPECT_LT(off[true], 0.2 * off[false]);
  EXPECT_LT(off[true], 2e-3);
}

TEST(OdometryWindow, StepCovarianceIsThatOfManyTrials) {
  Eigen::Matrix<double, 6, 6> scatter = Eigen::Matrix<double, 6, 6>::Zero(), told = scatter;
  constexpr int kTrials = 150;
  for (int seed = 0; seed < kTrials; ++seed) {
    Scene scene(1, 2, 60);
    const Pose truth = scene.frames[1].T_odom_left;
    std::mt19937 random(seed);
    std::normal_distribution<double> gauss(0, 0.5);
    for (StereoFrame& frame : scene.frames)
      for (StereoSighting& s : frame.sightings) {
        const Vec3 weights(2, 1, s.point % 2 == 0 ? 1 : 0.3);
        s.weight = weights.asDiagonal();
        s.pixel.left += gauss(random) / weights[0];
        s.pixel.row += gauss(random) / weights[1];
        s.pixel.right += gauss(random) / weights[2];
      }
    RefineWindow(scene.camera, 1, {&scene.frames[0], &scene.frames[1]}, 1, scene.points);
    const Vec6 error = (scene.frames[1].T_odom_left.inverse() * truth).Log();
    scatter += error * error.transpose() / kTrials;
    told +=
        StepCovariance(scene.camera, scene.frames[0], scene.frames[1], scene.points, 0.5) / kTrials;
  }
  for (int k = 0; k < 6; ++k) {
    const double ratio = std::sqrt(scatter(k, k) / told(k, k));
    EXPECT_GT(ratio, 0.8) << k;
    EXPECT_LT(ratio, 1.25) << k;
  }
}

TEST(OdometryWindow, ResidualScaleIsTheirStandardDeviation) {
  Scene scene(1, 1, 400);
  std::mt19937 random(1);
  std::normal_distribution<double> gauss(0, 0.7);
  for (StereoSighting& s : scene.frames[0].sightings) {
    s.pixel.left += gauss(random);
    s.pixel.row += 3 * gauss(random);
    s.pixel.right = NAN;
  }
  EXPECT_LT((ResidualScale(scene.camera, scene.frames[0], scene.points) - Vec3(0.7, 2.1, 0)).norm(),
            0.2);
  for (std::size_t i = 0; i < 40; ++i) scene.frames[0].sightings[i].pixel.row += 30;
  EXPECT_NEAR(ResidualScale(scene.camera, scene.frames[0], scene.points).y(), 2.1, 0.4)
      << "by what fits";
  for (StereoSighting& s : scene.frames[0].sightings) s.weight(0, 0) = 10;
  EXPECT_NEAR(ResidualScale(scene.camera, scene.frames[0], scene.points).x(), 7, 1.2) << "weighted";
  scene.frames[0].sightings.clear();
  EXPECT_EQ(ResidualScale(scene.camera, scene.frames[0], scene.points), Vec3(0, 0, 0));
}

TEST(OdometryWindow, WithoutCommonPointsTheStepIsUnknown) {
  Scene scene(1, 2, 20);
  for (StereoSighting& s : scene.frames[1].sightings) s.point += 1000;
  EXPECT_GT(StepCovariance(scene.camera, scene.frames[0], scene.frames[1], scene.points, 0.5)(0, 0),
            1e4);
}

}  // namespace
}  // namespace sslcd
