// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/stereo/rig_check.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "sslcd/stereo/row_error.h"

namespace sslcd {
namespace {

constexpr double kSure = 0.03;  // [px] rows that fit so well leave nothing to do; no burst tells columns better

std::optional<double> RowErrorOf(const StereoCamera& camera, std::size_t frames, const PairLoader& load,
                                 const StereoOdometryOptions& options) {
  constexpr std::size_t kPairs = 8;
  std::vector<std::pair<Image, Image>> images;
  for (std::size_t i = 0; i < frames; i += (frames + kPairs - 1) / kPairs)
    if (auto pair = load(i)) images.push_back(std::move(*pair));
  std::vector<StereoView> views;
  for (const auto& [left, right] : images) views.push_back({left.view(), right.view()});
  return RowError(camera, views, options);
}

/// The camera as bursts of frames have it: as many as fill a window, from evenly spread ones on.
std::vector<StereoCamera> InBursts(const StereoCamera& camera, std::size_t frames, const PairLoader& load,
                                   const StereoOdometryOptions& options) {
  constexpr std::size_t kBursts = 8, kWindows = 3;  // the most bursts; the most frames of one, in windows
  const std::size_t most = kWindows * static_cast<std::size_t>(options.window);
  std::vector<StereoCamera> found;
  std::size_t next = 0;
  while (next < frames) {
    const std::size_t first = next;
    StereoOdometry odometry(camera, options);
    std::optional<StereoCamera> value;
    OdometryStatus status = OdometryStatus::kFirst;
    for (; next < std::min(frames, first + most) && !value && status != OdometryStatus::kLost; ++next) {
      const auto pair = load(next);
      status =
          (pair ? odometry.AddFrame({pair->first.view(), pair->second.view()}) : odometry.AddMissingFrame()).status;
      value = odometry.Calibrated();
    }
    if (value) found.push_back(*value);
    next = std::max(next, first + frames / kBursts);
  }
  return found;
}

double MiddleOf(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return 0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]);
}

/// The median of what was found, as far as it is surer than calibration. Standard deviations: `off` of calibration, and
/// `least` of what was found at best; else it is as sure as its scatter says.
double Believed(const std::vector<double>& found, double calibrated, double off, double least) {
  const double median = MiddleOf(found);
  std::vector<double> scatter;
  for (double value : found) scatter.push_back(std::abs(value - median));
  const double error = 1.2533 * 1.4826 * MiddleOf(scatter) / std::sqrt(static_cast<double>(found.size()));
  const double sigma = found.size() < 2 ? 3 * least : std::max(least, error);
  return calibrated + (median - calibrated) * off * off / (off * off + sigma * sigma);
}

}  // namespace

RigCheck CheckRig(const StereoCamera& camera, std::size_t frames, const PairLoader& load,
                  const StereoOdometryOptions& options) {
  constexpr double kShare = 0.25, kLeast = 0.2;  // [px]; the latter is the scatter of bursts of ideal images
  constexpr int kLooks = 2;                      // as calibrated, points do not fit that do afterwards
  RigCheck check{RowErrorOf(camera, frames, load, options), camera};
  if (!options.calibrate || !check.row_error || *check.row_error < kSure) return check;
  for (int look = 0; look < kLooks; ++look) {
    const std::vector<StereoCamera> found = InBursts(check.camera, frames, load, options);
    if (found.empty()) return check;
    std::vector<double> at_infinity, tangential;
    for (const StereoCamera& burst : found) {
      at_infinity.push_back(burst.disparity_at_infinity);
      tangential.push_back(burst.left.tangential);
    }
    const double off = *check.row_error, fy = camera.left.fy;
    check.camera.disparity_at_infinity = Believed(at_infinity, camera.disparity_at_infinity, off, kSure);
    // It moves rows by p1 fy (x^2 + 3 y^2), a quarter of p1 fy where most points are.
    check.camera.left.tangential = Believed(tangential, camera.left.tangential, off / kShare / fy, kLeast / fy);
  }
  return check;
}

}  // namespace sslcd
