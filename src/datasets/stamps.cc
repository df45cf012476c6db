// SPDX-License-Identifier: BSD-3-Clause
#include "datasets/stamps.h"

#include <algorithm>
#include <cmath>

#include "core/median.h"
#include "formats/number_text.h"
#include "formats/text_rows.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

std::string Seconds(double stamp) { return FixedNumber(stamp, 3) + " s"; }

std::string Span(const std::vector<double>& stamps) {
  return std::to_string(stamps.size()) + " stamps from " + Seconds(stamps.front()) + " to " +
         Seconds(stamps.back());
}

}  // namespace

std::vector<double> ReadTimes(const std::string& path) {
  std::vector<double> stamps;
  TextRows row(path);
  while (row.Next()) {
    if (row.size() != 1)
      row.Fail("found " + std::to_string(row.size()) + " columns, expected one stamp [s]");
    const double stamp = row.Number(0);
    if (!std::isfinite(stamp)) row.Fail("the stamp is not finite");
    if (!stamps.empty() && !(stamp > stamps.back())) {
      row.Fail("stamp " + std::string(row.Text(0)) +
               " does not come after the one before: stamps must increase");
    }
    stamps.push_back(stamp);
  }
  return stamps;
}

double MedianStep(const std::vector<double>& stamps) {
  if (stamps.size() < 2) return 0;
  std::vector<double> steps;
  for (std::size_t i = 1; i < stamps.size(); ++i) steps.push_back(stamps[i] - stamps[i - 1]);
  return Median(std::move(steps));
}

std::optional<std::string> GapWarning(const std::vector<double>& stamps) {
  const double limit = 10 * MedianStep(stamps);
  int gaps = 0;
  std::size_t first = 0;
  for (std::size_t i = 1; i < stamps.size(); ++i) {
    if (stamps[i] - stamps[i - 1] > limit && gaps++ == 0) first = i;
  }
  if (gaps == 0) return std::nullopt;
  return std::to_string(gaps) + " gap(s) in the stamps, the first of " +
         Seconds(stamps[first] - stamps[first - 1]) + " before frame " + std::to_string(first);
}

std::vector<std::size_t> NearestPoses(const std::vector<double>& stamps,
                                      const Trajectory& trajectory, const std::string& path) {
  // A single frame has no step; KITTI's 0.1 s replaces it.
  const double tolerance = 0.5 * (stamps.size() < 2 ? 0.1 : MedianStep(stamps));
  const std::vector<double>& given = trajectory.stamps;
  std::vector<std::size_t> poses;
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    auto nearest = std::lower_bound(given.begin(), given.end(), stamps[i]);
    const bool before_is_nearer =
        nearest == given.end() ||
        (nearest != given.begin() && stamps[i] - *(nearest - 1) < *nearest - stamps[i]);
    if (before_is_nearer && nearest != given.begin()) --nearest;
    if (nearest == given.end() || !(std::abs(*nearest - stamps[i]) <= tolerance)) {
      throw Error(ErrorKind::kBadInput, {path},
                  "no pose for frame " + std::to_string(i) + " at " + Seconds(stamps[i]) +
                      " (to half a frame step); the frames: " + Span(stamps) + ", the poses: " +
                      Span(given) + ". Give every frame a pose, or shorten the list of frames");
    }
    poses.push_back(static_cast<std::size_t>(nearest - given.begin()));
  }
  return poses;
}

std::string TimesText(const std::vector<double>& stamps) {
  std::string text;
  for (const double stamp : stamps) text += FixedNumber(stamp, 6) + "\n";
  return text;
}

}  // namespace sslcd
