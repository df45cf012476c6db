// SPDX-License-Identifier: BSD-3-Clause
// Errors and times of stereo odometry. usage: odometry_bench FOLDER[:POSES] ... A folder has
// calib.txt, image_2 and image_3 (or image_l and image_r), and groundtruth.txt (otherwise name
// POSES). Prints one row per folder: KITTI's errors (eval/segment_error.h) over sub-paths of 10,
// 20, ... 100, 200, ... 800 m that start at any frame, with the disparity at infinity from
// CheckRig; the ATE after SE(3) alignment, and the relative error of the path length; the squared
// errors of the steps normalised by their covariances (median and mean per degree of freedom;
// ideal: .89 and 1); wall and processor time of AddFrame without reading the images.
#include <sys/resource.h>

#include <Eigen/Cholesky>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "core/median.h"
#include "eval/segment_error.h"
#include "sslcd/eval/trajectory_error.h"
#include "stereo/stereo_folder.h"

namespace sslcd {
namespace {

double CpuSeconds() {
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) { return t.tv_sec + 1e-6 * t.tv_usec; };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

void Measure(const std::string& folder, const std::string& poses) {
  const StereoFolder input = OpenStereoFolder(folder, poses);
  StereoCamera camera = input.camera;
  camera.disparity_at_infinity =
      CheckRig(input.camera, input.left.size(), Loader(input), {}).disparity_at_infinity;
  StereoOdometry odometry(camera, {});
  std::vector<Pose> est, ref = input.truth;
  int lost = 0, keyframes = 0;
  std::vector<double> normalised;
  double points = 0, wall = 0, cpu = 0;
  for (std::size_t i = 0; i < input.left.size(); ++i) {
    const cv::Mat left = cv::imread(input.left[i], cv::IMREAD_UNCHANGED);
    const cv::Mat right = cv::imread(input.right[i], cv::IMREAD_UNCHANGED);
    const auto start = std::chrono::steady_clock::now();
    const double cpu_start = CpuSeconds();
    const OdometryStep step = odometry.AddFrame({ViewOf(left), ViewOf(right)});
    cpu += CpuSeconds() - cpu_start;
    wall += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    est.push_back(step.T_odom_cam);
    lost += step.status == OdometryStatus::kLost;
    keyframes += step.keyframe;
    points += step.points;
    if (i == 0 || i >= ref.size()) continue;
    const Vec6 error =
        ((est[i - 1].inverse() * est[i]).inverse() * (ref[i - 1].inverse() * ref[i])).Log();
    normalised.push_back(error.dot(step.covariance.ldlt().solve(error)) / 6);
  }
  const std::size_t frames = est.size();
  est.resize(std::min(est.size(), ref.size()));
  ref.resize(est.size());
  std::vector<double> lengths;
  for (int k = 1; k <= 10; ++k) lengths.push_back(10 * k);
  for (int k = 2; k <= 8; ++k) lengths.push_back(100 * k);
  const SegmentError error = ComputeSegmentError(est, ref, lengths);
  const double ate = ComputeAte(est, ref).error.rmse;
  const double scale = Align(est, ref, Alignment::kSim3).scale;
  std::printf(
      "%-40s at infinity %+.3f px  frames %zu  lost %d  keyframes %d  points %.0f  translation "
      "%.3f %%  rotation %.5f "
      "deg/m  "
      "ATE %.4f m  scale %+.4f %%  steps over covariance %.2f %.2f  wall %.1f ms  cpu %.1f ms\n",
      folder.c_str(), camera.disparity_at_infinity, frames, lost, keyframes, points / frames,
      100 * error.translation, error.rotation_rad_per_m * 180 / M_PI, ate, 100 * (1 / scale - 1),
      normalised.empty() ? NAN : Median(normalised),
      std::accumulate(normalised.begin(), normalised.end(), 0.) /
          static_cast<double>(normalised.size()),
      1e3 * wall / frames, 1e3 * cpu / frames);
}

}  // namespace
}  // namespace sslcd

int main(int argc, char** argv) try {
  if (argc < 2) {
    std::fprintf(stderr, "usage: odometry_bench FOLDER[:POSES] ...\n");
    return 2;
  }
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    const std::size_t colon = argument.find(':');
    sslcd::Measure(argument.substr(0, colon),
                   colon == std::string::npos ? "" : argument.substr(colon + 1));
  }
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
