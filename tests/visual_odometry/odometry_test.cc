// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/visual_odometry/odometry.h"

#include <gmock/gmock.h>

#include <Eigen/Cholesky>
#include <cstdint>
#include <cstring>
#include <opencv2/core/utility.hpp>
#include <vector>

#include "odometry/odometry_noise.h"
#include "sslcd/core/error.h"
#include "stereo/tunnel.h"

namespace sslcd {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// Straight on for a while, then to the left.
std::vector<Pose> Course(int frames, double step_m = 0.4, double turn_rad = 0.04) {
  std::vector<Pose> poses(1);
  for (int i = 1; i < frames; ++i)
    poses.push_back(poses.back() * Pose::Trans(0, 0, step_m) *
                    Pose::RotY(i < frames / 2 ? 0 : -turn_rad));
  return poses;
}

double Metres(const Pose& a, const Pose& b) { return (a.translation() - b.translation()).norm(); }
double Radians(const Pose& a, const Pose& b) { return (a.inverse() * b).so3().Log().norm(); }

TEST(StereoOdometry, FollowsTheCamera) {
  const Tunnel tunnel;
  StereoOdometry odometry(Tunnel::Camera(), {});
  const std::vector<Pose> truth = Course(16);
  std::vector<Pose> poses;
  double chi2 = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const OdometryStep step = odometry.AddFrame(tunnel.Look(truth[i]).view());
    EXPECT_EQ(step.status, i == 0 ? OdometryStatus::kFirst : OdometryStatus::kTracked)
        << i << ": " << step.reason;
    EXPECT_THAT(step.reason, testing::StrEq(""));
    EXPECT_GT(step.points, 100);
    poses.push_back(step.T_odom_cam);
    if (i == 0) continue;
    const Vec6 error =
        ((poses[i - 1].inverse() * poses[i]).inverse() * (truth[i - 1].inverse() * truth[i])).Log();
    chi2 += error.dot(step.covariance.ldlt().solve(Eigen::Matrix<double, 6, 1>(error)));
  }
  EXPECT_EQ(Metres(poses[0], Pose()), 0);
  EXPECT_LT(Metres(poses.back(), truth.back()), 0.0025 * 6)
      << "a quarter per cent of 6 m, with images of 320x240";
  EXPECT_LT(Radians(poses.back(), truth.back()), 1e-3);
  const double mean_chi2 = chi2 / (truth.size() - 1);
  EXPECT_GT(mean_chi2, 0.6) << "six, if the covariance is right; it is on the safe side";
  EXPECT_LT(mean_chi2, 6);
}

TEST(StereoOdometry, StandsStillWhenTheCameraDoes) {
  const Tunnel tunnel;
  StereoOdometry odometry(Tunnel::Camera(), {});
  for (int i = 0; i < 12; ++i) {
    // The noise depends on the pose: a nanometre makes it another one.
    const OdometryStep step =
        odometry.AddFrame(tunnel.Look(Pose::Trans(1e-6 * i, 0, 0), 1, 2).view());
    EXPECT_EQ(step.keyframe, i == 0);
    EXPECT_LT(Metres(step.T_odom_cam, Pose()), 3e-3) << i;
    EXPECT_LT(Radians(step.T_odom_cam, Pose()), 5e-4) << i;
  }
}

TEST(StereoOdometry, IsThatOfTheReferenceCamera) {
  const Tunnel tunnel;
  const Pose T_left_ref = Pose::Trans(0.5, -0.2, 0.1);
  StereoCamera camera = Tunnel::Camera();
  camera.left.offset = T_left_ref.translation();
  StereoOdometry odometry(camera, {}), of_left(Tunnel::Camera(), {});
  Pose T_odom_ref;
  OdometryStep step, left;
  const std::vector<Pose> truth = Course(6, 0.4, 0.1);
  for (const Pose& pose : truth) {
    const Tunnel::Pair images = tunnel.Look(pose);
    step = odometry.AddFrame(images.view());
    left = of_left.AddFrame(images.view());
  }
  const Pose expected = T_left_ref.inverse() * truth.back() * T_left_ref;
  EXPECT_LT(Metres(step.T_odom_cam, expected), 0.02);
  EXPECT_GT(Metres(left.T_odom_cam, expected), 0.1) << "or the test shows nothing";
  // Rotation is the same for both, and so is its covariance; the lever adds to that of the
  // translation.
  EXPECT_TRUE(step.covariance.bottomRightCorner(3, 3).isApprox(
      left.covariance.bottomRightCorner(3, 3), 1e-6));
  EXPECT_FALSE(
      step.covariance.topLeftCorner(3, 3).isApprox(left.covariance.topLeftCorner(3, 3), 1e-3));
}

/// What happens to the frame in the middle of a course, and to those after it.
struct Mishap {
  std::vector<OdometryStep> steps;
  std::vector<Pose> truth = Course(12, 0.3, 0.02);
  static constexpr int kWhen = 6;

  template <class What>
  Mishap(const StereoOdometryOptions& options, What&& what) {
    const Tunnel tunnel;
    StereoOdometry odometry(Tunnel::Camera(), options);
    for (std::size_t i = 0; i < truth.size(); ++i)
      steps.push_back(i == kWhen ? what(odometry)
                                 : odometry.AddFrame(tunnel.Look(truth[i]).view()));
  }
};

void ExpectBridged(const Mishap& mishap) {
  const OdometryStep& lost = mishap.steps[Mishap::kWhen];
  const OdometryStep& before = mishap.steps[Mishap::kWhen - 1];
  EXPECT_EQ(lost.status, OdometryStatus::kLost);
  EXPECT_THAT(std::string(lost.reason), Not(IsEmpty()));
  EXPECT_GT(lost.covariance.trace(), 100 * before.covariance.trace());
  EXPECT_LT(Metres(lost.T_odom_cam, mishap.truth[Mishap::kWhen]), 0.05) << "it moves on as before";
  for (std::size_t i = Mishap::kWhen + 1; i < mishap.steps.size(); ++i) {
    EXPECT_EQ(mishap.steps[i].status, OdometryStatus::kTracked) << i;
    EXPECT_LT(Metres(mishap.steps[i].T_odom_cam, mishap.truth[i]), 0.02) << i;
  }
}

TEST(StereoOdometry, GoesOnAfterABlackFrame) {
  const cv::Mat black(240, 320, CV_8UC1, cv::Scalar(0));
  ExpectBridged(Mishap({}, [&](StereoOdometry& o) {
    return o.AddFrame({ViewOf(black), ViewOf(black)});
  }));
}

TEST(StereoOdometry, SaysWhyThereIsNothingToFollow) {
  const cv::Mat black(240, 320, CV_8UC1, cv::Scalar(0));
  const Tunnel::Pair pair = Tunnel().Look(Pose());
  const StereoView sides = pair.view();
  const auto second = [](const StereoView& images, bool missing) {
    StereoOdometry odometry(Tunnel::Camera(), {});
    missing ? odometry.AddMissingFrame() : odometry.AddFrame(images);
    return std::string(odometry.AddFrame(images).reason);
  };
  EXPECT_THAT(second({ViewOf(black), ViewOf(black)}, false), HasSubstr("corners in the images"));
  EXPECT_THAT(second({sides.right, sides.left}, false), HasSubstr("swapped"));
  EXPECT_THAT(second(sides, true), HasSubstr("no frame before"));
}

TEST(StereoOdometry, GoesOnAfterAMissingFrame) {
  ExpectBridged(Mishap({}, [](StereoOdometry& o) { return o.AddMissingFrame(); }));
}

TEST(StereoOdometry, GoesOnAfterImagesOfSomethingElse) {
  const Tunnel::Pair other = Tunnel(7).Look(Pose());
  ExpectBridged(Mishap({}, [&](StereoOdometry& o) { return o.AddFrame(other.view()); }));
}

TEST(StereoOdometry, StartsAgainAtItsGuessAfterThreeLostFrames) {
  StereoOdometry odometry(Tunnel::Camera(), {});
  const Tunnel tunnel, other(7);
  const std::vector<Pose> truth = Course(12, 0.3, 0);
  std::vector<OdometryStatus> statuses;
  OdometryStep step;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    step = odometry.AddFrame((i < 6 ? tunnel : other).Look(truth[i]).view());
    statuses.push_back(step.status);
    if (i == 9) {
      EXPECT_LT(step.covariance.trace(), 1e-3)
          << "measured from the new start, not from before the gap";
    }
  }
  EXPECT_EQ(std::count(statuses.begin(), statuses.end(), OdometryStatus::kLost), 3);
  EXPECT_EQ(statuses[9], OdometryStatus::kTracked);
  EXPECT_LT(Metres(step.T_odom_cam, truth.back()), 0.1);
}

TEST(StereoOdometry, FollowsASuddenTurnAndAChangeOfLight) {
  const Tunnel tunnel;
  StereoOdometry odometry(Tunnel::Camera(), {});
  for (int i = 0; i < 4; ++i) odometry.AddFrame(tunnel.Look(Pose::Trans(0, 0, 0.3 * i)).view());
  const Pose turned = Pose::Trans(0, 0, 1.2) * Pose::RotY(0.17);
  OdometryStep step = odometry.AddFrame(tunnel.Look(turned).view());
  EXPECT_EQ(step.status, OdometryStatus::kTracked) << step.reason;
  EXPECT_LT(Metres(step.T_odom_cam, turned), 0.02);
  EXPECT_LT(Radians(step.T_odom_cam, turned), 2e-3);
  const Pose next = turned * Pose::Trans(0, 0, 0.3);
  step = odometry.AddFrame(tunnel.Look(next, 0.5).view());
  EXPECT_EQ(step.status, OdometryStatus::kTracked) << step.reason;
  EXPECT_LT(Metres(step.T_odom_cam, next), 0.03);
}

TEST(StereoOdometry, WithNothingToSeeThereIsNothingToFollow) {
  const cv::Mat grey(240, 320, CV_8UC1, cv::Scalar(90));
  StereoOdometry odometry(Tunnel::Camera(), {});
  EXPECT_EQ(odometry.AddFrame({ViewOf(grey), ViewOf(grey)}).status, OdometryStatus::kFirst);
  for (int i = 0; i < 5; ++i) {
    const OdometryStep step = odometry.AddFrame({ViewOf(grey), ViewOf(grey)});
    EXPECT_EQ(step.status, OdometryStatus::kLost);
    EXPECT_EQ(Metres(step.T_odom_cam, Pose()), 0);
  }
  const Tunnel tunnel;
  EXPECT_EQ(odometry.AddFrame(tunnel.Look(Pose()).view()).status, OdometryStatus::kLost)
      << "nothing to compare with";
  EXPECT_EQ(odometry.AddFrame(tunnel.Look(Pose::Trans(0, 0, 0.1)).view()).status,
            OdometryStatus::kTracked);
  // A lens cap on one eye only.
  StereoOdometry one_eyed(Tunnel::Camera(), {});
  const Tunnel::Pair pair = tunnel.Look(Pose());
  EXPECT_EQ(one_eyed.AddFrame({ViewOf(pair.left), ViewOf(grey)}).points, 0);
}

TEST(StereoOdometry, RefusesWhatIsNoPairAndGoesOn) {
  const Tunnel tunnel;
  StereoOdometry odometry(Tunnel::Camera(), {});
  odometry.AddFrame(tunnel.Look(Pose()).view());
  const cv::Mat small(120, 160, CV_8UC1, cv::Scalar(90));
  const Tunnel::Pair next = tunnel.Look(Pose::Trans(0, 0, 0.2));
  EXPECT_THROW(odometry.AddFrame({ViewOf(next.left), ViewOf(small)}), Error);
  EXPECT_THROW(odometry.AddFrame({ViewOf(small), ViewOf(small)}), Error);
  EXPECT_THROW(odometry.AddFrame({}), Error);
  const OdometryStep step = odometry.AddFrame(next.view());
  EXPECT_LT(Metres(step.T_odom_cam, Pose::Trans(0, 0, 0.2)), 0.01);
  EXPECT_THROW(StereoOdometry(StereoCamera{}, {}), Error);
}

TEST(StereoOdometry, IsTheSameForAnyNumberOfThreads) {
  const Tunnel tunnel;
  const int threads = cv::getNumThreads();
  std::vector<Pose> poses[2];
  for (const int run : {0, 1}) {
    cv::setNumThreads(run == 0 ? 1 : 4);
    StereoOdometry odometry(Tunnel::Camera(), {});
    for (const Pose& pose : Course(8))
      poses[run].push_back(odometry.AddFrame(tunnel.Look(pose).view()).T_odom_cam);
  }
  cv::setNumThreads(threads);
  for (std::size_t i = 0; i < poses[0].size(); ++i)
    EXPECT_EQ(std::memcmp(poses[0][i].data(), poses[1][i].data(), 7 * sizeof(double)), 0) << i;
}

TEST(StereoOdometry, NeitherUsesNorMovesTheHostsRandomNumbers) {
  const Tunnel tunnel;
  const std::uint64_t before = cv::theRNG().state;
  std::vector<Pose> poses[2];
  for (const std::uint64_t state : {std::uint64_t{1}, std::uint64_t{77777}}) {
    cv::theRNG().state = state;
    StereoOdometry odometry(Tunnel::Camera(), {});
    std::vector<Pose>& run = poses[state != 1];
    for (const Pose& pose : Course(4))
      run.push_back(odometry.AddFrame(tunnel.Look(pose).view()).T_odom_cam);
    EXPECT_EQ(cv::theRNG().state, state);
  }
  cv::theRNG().state = before;
  for (std::size_t i = 0; i < poses[0].size(); ++i)
    EXPECT_EQ(std::memcmp(poses[0][i].data(), poses[1][i].data(), 7 * sizeof(double)), 0) << i;
}

TEST(StereoOdometryNoise, IsThatOfRealImagesWhereNothingIsKnown) {
  const OdometrySigmas far = SigmasOf(Pose::Trans({0, 0, 100}), StereoOdometryNoise());
  EXPECT_NEAR(far.horizontal, 0.05, 0.01);
  EXPECT_NEAR(far.rotation, 0.005, 0.001) << "KITTI's images: half a degree and less over 100 m";
  EXPECT_EQ(far.vertical, far.horizontal);
}

TEST(StereoOdometryNoise, IsTrustedAsFarAsRowsAgree) {
  // Measured over 20 m of HALV-sim: 0.08 mrad per sqrt(m) in heading, 1 mm per sqrt(m) each way.
  const OdometryNoise ideal = StereoOdometryNoise(0.), real = StereoOdometryNoise();
  const OdometrySigmas far = SigmasOf(Pose::Trans({0, 0, 20}), ideal);
  EXPECT_NEAR(far.rotation, 0.00045, 5e-5);
  EXPECT_NEAR(far.horizontal, 0.009, 5e-4)
      << "twice that: rows do not tell of dark or blurred images";
  EXPECT_NEAR(SigmasOf(Pose::Trans({0, 0, 0.67}), ideal).horizontal, 0.002, 2e-4)
      << "1.2 mm measured, in all";
  EXPECT_NEAR(ideal.rotation_turn / real.rotation_turn, ideal.rotation_walk / real.rotation_walk,
              1e-12);
  EXPECT_NEAR(StereoOdometryNoise(0.006 / 514).rotation_walk, 1e-4, 4e-6) << "rendered HALV-sim";
  EXPECT_NEAR(StereoOdometryNoise(0.17 / 718).rotation_walk, real.rotation_walk, 3e-5)
      << "KITTI in colour";
  EXPECT_EQ(StereoOdometryNoise(0.49 / 718).rotation_walk, real.rotation_walk)
      << "KITTI in grey: no worse than unknown";
}

}  // namespace
}  // namespace sslcd
