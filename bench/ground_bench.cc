// SPDX-License-Identifier: BSD-3-Clause
// Errors and success rate of AlignGround. usage: ground_bench [--path M] [--off M] FOLDER[:POSES]
// ... Folders as for odometry_bench. The pairs are those of LoopViewOptions and AlignmentRange:
// every 2 m of path, a frame and an earlier one that sees the same ground, at least --path (30 m)
// before. The guess is the truth plus noise of --off (0.2 m) horizontally and 0.5 degrees in
// heading (standard deviations). CheckRig estimates the disparity at infinity. Prints one row per
// folder: errors in the second camera's axes, and squared errors normalised by their covariances,
// as median and mean per degree of freedom (ideal: .89 and 1).
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "core/median.h"
#include "sslcd/closing/options.h"
#include "sslcd/core/error.h"
#include "sslcd/ground/ground_alignment.h"
#include "stereo/stereo_folder.h"

namespace sslcd {
namespace {

struct Setup {
  double gap_m = 30, off_m = 0.2;
};

Pose Disturbed(const Pose& T, double off_m, std::mt19937& random) {
  std::normal_distribution<double> normal;
  Vec6 error = Vec6::Zero();
  error[0] = off_m * normal(random);
  error[2] = off_m * normal(random);
  error[4] = 0.5 * M_PI / 180 * normal(random);
  return T * Pose::Exp(error);
}

void Measure(const std::string& folder, const std::string& poses, const Setup& setup) {
  const StereoFolder input = OpenStereoFolder(folder, poses);
  const std::size_t count = std::min(input.left.size(), input.truth.size());
  if (count == 0) throw Error(ErrorKind::kBadInput, {folder}, "has no frames with ground truth");
  StereoCamera camera = input.camera;
  camera.disparity_at_infinity = CheckRig(camera, count, Loader(input), {}).disparity_at_infinity;
  LoopViewOptions views;
  const GroundOptions ground;
  const int rows = cv::imread(input.left[0], cv::IMREAD_UNCHANGED).rows;
  views.ahead_m = AlignmentRange(camera.left, rows, ground.height_m).value_or(views.ahead_m);
  const auto spot = [&](std::size_t i) { return Vec3(input.truth[i] * Vec3(0, 0, views.ahead_m)); };
  std::vector<double> path{0}, right, down, ahead, turn, normalised;
  std::mt19937 random(1);
  int tried = 0, far_off = 0;
  double last = -views.every_m;
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0)
      path.push_back(path[i - 1] +
                     (input.truth[i].translation() - input.truth[i - 1].translation()).norm());
    if (path[i] < last + views.every_m) continue;
    double nearest = views.apart_m;
    std::size_t old = i;
    for (std::size_t j = 0; j < i && path[i] - path[j] >= setup.gap_m; ++j) {
      const double apart = (spot(j) - spot(i)).norm();
      if (apart < nearest) nearest = apart, old = j;
    }
    if (old == i) continue;
    last = path[i];
    ++tried;
    cv::Mat images[4];
    const std::string* const files[] = {&input.left[old], &input.right[old], &input.left[i],
                                        &input.right[i]};
    for (int k = 0; k < 4; ++k) images[k] = cv::imread(*files[k], cv::IMREAD_UNCHANGED);
    const Pose T_old_new = input.truth[old].inverse() * input.truth[i];
    const auto found = AlignGround(
        {ViewOf(images[0]), ViewOf(images[1])}, {ViewOf(images[2]), ViewOf(images[3])}, camera,
        Disturbed(T_old_new, setup.off_m, random), ground, GroundAlignmentOptions());
    if (!found) continue;
    const Pose error = T_old_new.inverse() * found->T_a_b;
    right.push_back(error.translation().x());
    down.push_back(error.translation().y());
    ahead.push_back(error.translation().z());
    turn.push_back(error.so3().Log().norm() * 180 / M_PI);
    normalised.push_back(error.Log().dot(Pose::Matrix6(found->covariance.inverse()) * error.Log()) /
                         6);
    far_off += error.translation().norm() > 0.2;
  }
  std::printf("%-40s pairs %d  aligned %zu  off by 0.2 m or more %d", folder.c_str(), tried,
              turn.size(), far_off);
  const auto print = [](const char* name, std::vector<double> errors) {
    const double bias = Median(errors);
    for (double& error : errors) error = std::abs(error);
    std::printf("  %s %.3f (bias %+.3f)", name, Median(errors), bias);
  };
  if (!turn.empty()) {
    print("right", right), print("down", down), print("ahead", ahead);
    std::printf("  turn %.3f deg  over covariance %.2f %.2f", Median(turn), Median(normalised),
                std::accumulate(normalised.begin(), normalised.end(), 0.) /
                    static_cast<double>(normalised.size()));
  }
  std::printf("\n");
}

}  // namespace
}  // namespace sslcd

int main(int argc, char** argv) try {
  sslcd::Setup setup;
  int first = 1;
  for (; first + 1 < argc && argv[first][0] == '-'; first += 2) {
    const std::string option = argv[first];
    if (option != "--path" && option != "--off") break;
    (option == "--path" ? setup.gap_m : setup.off_m) = std::stod(argv[first + 1]);
  }
  if (first >= argc || argv[first][0] == '-')
    return std::fprintf(stderr, "usage: ground_bench [--path M] [--off M] FOLDER[:POSES] ...\n"), 2;
  for (int i = first; i < argc; ++i) {
    const std::string argument = argv[i];
    const std::size_t colon = argument.find(':');
    sslcd::Measure(argument.substr(0, colon),
                   colon == std::string::npos ? "" : argument.substr(colon + 1), setup);
  }
  return 0;
} catch (const std::exception& error) {
  return std::fprintf(stderr, "%s\n", error.what()), 1;
}
