// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/visual_odometry/odometry.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/median.h"
#include "visual_odometry/row_error.h"

namespace sslcd {
namespace {

// [px] a smaller row error needs no check; no burst measures more exactly
constexpr double kSure = 0.03;

std::optional<double> RowErrorOf(const StereoCamera& camera, std::size_t frames,
                                 const PairLoader& load, const StereoOdometryOptions& options) {
  constexpr std::size_t kPairs = 8;  // set by hand
  std::vector<std::pair<Image, Image>> images;
  for (std::size_t i = 0; i < frames; i += (frames + kPairs - 1) / kPairs)
    if (auto pair = load(i)) images.push_back(std::move(*pair));
  std::vector<StereoView> views;
  for (const auto& [left, right] : images) views.push_back({left.view(), right.view()});
  return RowError(camera, views, options);
}

/// Disparities at infinity of bursts of frames that fill a window, evenly spread over the sequence.
std::vector<double> InBursts(const StereoCamera& camera, std::size_t frames, const PairLoader& load,
                             const StereoOdometryOptions& options) {
  // largest number of bursts; largest number of frames of a burst, in windows. Set by hand.
  constexpr std::size_t kBursts = 8, kWindows = 6;
  const std::size_t most = kWindows * static_cast<std::size_t>(options.window);
  std::vector<double> found;
  std::size_t next = 0;
  while (next < frames) {
    const std::size_t first = next;
    StereoOdometry odometry(camera, options);
    std::optional<double> value;
    for (; next < std::min(frames, first + most) && !value; ++next) {
      if (const auto pair = load(next))
        odometry.AddFrame({pair->first.view(), pair->second.view()});
      else
        odometry.AddMissingFrame();
      value = odometry.DisparityAtInfinity();
    }
    if (value && std::abs(*value) < StereoCamera::kMostAtInfinity) found.push_back(*value);
    next = std::max(next, first + frames / kBursts);
  }
  return found;
}

/// Standard error of their median, assuming normal scatter with a few outliers.
double ErrorOfMedian(const std::vector<double>& values, double median) {
  constexpr double kUnknown = 0.1;  // [px] for a single burst; set by hand
  // Of a normal distribution: standard error of the median over that of the mean, sqrt(pi / 2), and
  // standard deviation over median absolute deviation.
  constexpr double kMedianError = 1.2533, kSigmasPerMedian = 1.4826;
  if (values.size() < 2) return kUnknown;
  std::vector<double> off;
  for (double value : values) off.push_back(std::abs(value - median));
  return kMedianError * kSigmasPerMedian * Median(off) /
         std::sqrt(static_cast<double>(values.size()));
}

}  // namespace

RigCheck CheckRig(const StereoCamera& camera, std::size_t frames, const PairLoader& load,
                  const StereoOdometryOptions& options) {
  const double calibrated = camera.disparity_at_infinity;
  RigCheck check{RowErrorOf(camera, frames, load, options), calibrated, false};
  if (!options.calibrate || !check.row_error || *check.row_error < kSure) return check;
  const std::vector<double> found = InBursts(camera, frames, load, options);
  check.unsure = found.empty();
  if (check.unsure) return check;
  const double median = Median(found);
  // A roll of the right camera by 0.4 degrees causes a change of up to 0.17 of the row error.
  constexpr double kRolled = 0.25;
  if (std::abs(median - calibrated) < kRolled * *check.row_error) return check;
  const double trust = std::pow(*check.row_error, 2);
  const double doubt = std::pow(std::max(kSure, ErrorOfMedian(found, median)), 2);
  check.disparity_at_infinity += (median - calibrated) * trust / (trust + doubt);
  return check;
}

}  // namespace sslcd
