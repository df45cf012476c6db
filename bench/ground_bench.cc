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
#include <optional>
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

constexpr double kFarOff = 0.2;  // [m]

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

// Errors of all pairs of a folder.
struct Errors {
  std::vector<double> right, down, ahead;  // [m]
  std::vector<double> turn;                // [deg]
  std::vector<double> normalised;          // squared errors by their covariances, over 6
  int tried = 0, far_off = 0;
};

std::vector<double> PathOf(const std::vector<Pose>& poses, std::size_t count) {
  std::vector<double> path{0};
  for (std::size_t i = 1; i < count; ++i)
    path.push_back(path[i - 1] + (poses[i].translation() - poses[i - 1].translation()).norm());
  return path;
}

// The earlier frame whose view of the ground is nearest to frame `now`; `now` if none is near.
std::size_t FindPartner(const std::vector<Pose>& truth, const std::vector<double>& path,
                        std::size_t now, const LoopViewOptions& views, double gap_m) {
  const auto spot = [&](std::size_t i) { return Vec3(truth[i] * Vec3(0, 0, views.ahead_m)); };
  double nearest = views.apart_m;
  std::size_t old = now;
  for (std::size_t j = 0; j < now && path[now] - path[j] >= gap_m; ++j) {
    const double apart = (spot(j) - spot(now)).norm();
    if (apart >= nearest) continue;
    nearest = apart;
    old = j;
  }
  return old;
}

std::optional<RelativePose> AlignFrames(const StereoFolder& input, const StereoCamera& camera,
                                        std::size_t old, std::size_t now, const Pose& guess) {
  cv::Mat images[4];
  const std::string* const files[] = {&input.left[old], &input.right[old], &input.left[now],
                                      &input.right[now]};
  for (int k = 0; k < 4; ++k) images[k] = cv::imread(*files[k], cv::IMREAD_UNCHANGED);
  return AlignGround({ViewOf(images[0]), ViewOf(images[1])}, {ViewOf(images[2]), ViewOf(images[3])},
                     camera, guess, GroundOptions(), GroundAlignmentOptions());
}

void AddError(const Pose& truth, const RelativePose& found, Errors& errors) {
  const Pose error = truth.inverse() * found.T_a_b;
  errors.right.push_back(error.translation().x());
  errors.down.push_back(error.translation().y());
  errors.ahead.push_back(error.translation().z());
  errors.turn.push_back(error.so3().Log().norm() * 180 / M_PI);
  errors.normalised.push_back(
      error.Log().dot(Pose::Matrix6(found.covariance.inverse()) * error.Log()) / 6);
  errors.far_off += error.translation().norm() > kFarOff;
}

void PrintRow(const std::string& folder, const Errors& errors) {
  std::printf("%-40s pairs %d  aligned %zu  off by %.1f m or more %d", folder.c_str(), errors.tried,
              errors.turn.size(), kFarOff, errors.far_off);
  const auto print = [](const char* name, std::vector<double> values) {
    const double bias = Median(values);
    for (double& value : values) value = std::abs(value);
    std::printf("  %s %.3f (bias %+.3f)", name, Median(values), bias);
  };
  if (!errors.turn.empty()) {
    print("right", errors.right);
    print("down", errors.down);
    print("ahead", errors.ahead);
    std::printf("  turn %.3f deg  over covariance %.2f %.2f", Median(errors.turn),
                Median(errors.normalised),
                std::accumulate(errors.normalised.begin(), errors.normalised.end(), 0.) /
                    static_cast<double>(errors.normalised.size()));
  }
  std::printf("\n");
}

void Measure(const std::string& folder, const std::string& poses, const Setup& setup) {
  const StereoFolder input = OpenStereoFolder(folder, poses);
  const std::size_t count = std::min(input.left.size(), input.truth.size());
  if (count == 0) throw Error(ErrorKind::kBadInput, {folder}, "has no frames with ground truth");
  StereoCamera camera = input.camera;
  camera.disparity_at_infinity = CheckRig(camera, count, Loader(input), {}).disparity_at_infinity;
  LoopViewOptions views;
  const int rows = cv::imread(input.left[0], cv::IMREAD_UNCHANGED).rows;
  views.ahead_m =
      AlignmentRange(camera.left, rows, GroundOptions().height_m).value_or(views.ahead_m);
  const std::vector<double> path = PathOf(input.truth, count);
  Errors errors;
  std::mt19937 random(1);
  double last = -views.every_m;
  for (std::size_t i = 0; i < count; ++i) {
    if (path[i] < last + views.every_m) continue;
    const std::size_t old = FindPartner(input.truth, path, i, views, setup.gap_m);
    if (old == i) continue;
    last = path[i];
    ++errors.tried;
    const Pose T_old_new = input.truth[old].inverse() * input.truth[i];
    const auto found =
        AlignFrames(input, camera, old, i, Disturbed(T_old_new, setup.off_m, random));
    if (found) AddError(T_old_new, *found, errors);
  }
  PrintRow(folder, errors);
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
  if (first >= argc || argv[first][0] == '-') {
    std::fprintf(stderr, "usage: ground_bench [--path M] [--off M] FOLDER[:POSES] ...\n");
    return 2;
  }
  for (int i = first; i < argc; ++i) {
    const std::string argument = argv[i];
    const std::size_t colon = argument.find(':');
    sslcd::Measure(argument.substr(0, colon),
                   colon == std::string::npos ? "" : argument.substr(colon + 1), setup);
  }
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
