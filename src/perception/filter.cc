// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/perception/filter.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <utility>

#include "core/finite.h"

namespace sslcd {
namespace {

bool IsValid(const Detection& detection) {
  const auto is_finite = [](double value) { return std::isfinite(value); };
  return detection.score >= 0 && detection.score <= 1 && HasValidGeometry(detection) &&
         std::all_of(std::begin(kCueRows), std::end(kCueRows), [&](const CueRow& row) {
           const std::vector<float>& vector = detection.appearance[row.cue];
           return std::all_of(vector.begin(), vector.end(), is_finite);
         });
}

bool HasRightSize(const Vec3& dims, const DetectionFilterOptions& options) {
  return (dims.array() >= options.min_size_m).all() && (dims.array() <= options.max_size_m).all();
}

// Removes all but the `most` with the highest scores. Returns how many it removed.
int DropBeyond(std::size_t most, std::vector<Detection>& detections) {
  if (detections.size() <= most) return 0;
  std::vector<std::size_t> rank(detections.size());
  std::iota(rank.begin(), rank.end(), 0);
  std::stable_sort(rank.begin(), rank.end(), [&](std::size_t a, std::size_t b) {
    return detections[a].score > detections[b].score;
  });
  rank.resize(most);
  std::sort(rank.begin(), rank.end());
  std::vector<Detection> best;
  for (const std::size_t i : rank) best.push_back(std::move(detections[i]));
  const std::size_t dropped = detections.size() - most;
  detections = std::move(best);
  return static_cast<int>(dropped);
}

/// The counter of this detection.
int& Classify(const Detection& detection, const DetectionFilterOptions& options,
              FilterReport& report) {
  if (!IsValid(detection)) return report.invalid;
  if (detection.score < options.min_score) return report.low_score;
  if (detection.T_cam_object.translation().norm() > options.max_range_m) return report.too_far;
  if (!HasRightSize(detection.dims, options)) return report.wrong_size;
  return report.kept;
}

}  // namespace

FilterReport& FilterReport::operator+=(const FilterReport& other) {
  kept += other.kept;
  invalid += other.invalid;
  low_score += other.low_score;
  too_far += other.too_far;
  wrong_size += other.wrong_size;
  too_many += other.too_many;
  return *this;
}

FilterReport FilterDetections(std::vector<Detection>& detections,
                              const DetectionFilterOptions& options) {
  FilterReport report;
  const auto drop = [&](const Detection& detection) {
    int& counter = Classify(detection, options, report);
    ++counter;
    return &counter != &report.kept;
  };
  // remove_if calls the predicate once per element, in order.
  detections.erase(std::remove_if(detections.begin(), detections.end(), drop), detections.end());
  report.too_many = DropBeyond(static_cast<std::size_t>(options.max_count), detections);
  report.kept -= report.too_many;
  return report;
}

void DescribeFields(FieldVisitor& visitor, DetectionFilterOptions& options) {
  visitor.Everyday("higher: fewer false objects, but also fewer true ones")
      .Real("min_score", options.min_score, 0, 1, "detections with a lower score are dropped");
  visitor.Everyday("larger: more objects, but the far ones are less precise")
      .Real("max_range_m", options.max_range_m, 0.1, 1e4,
            "detections farther from the camera are dropped");
  visitor.Real("min_size_m", options.min_size_m, 0, 1e3,
               "detections whose length, width or height is smaller are dropped");
  visitor.Real("max_size_m", options.max_size_m, 0, 1e3,
               "detections whose length, width or height is larger are dropped");
  visitor.Integer("max_count", options.max_count, 1, 1000000,
                  "most detections of a frame; those with lower scores are dropped");
}

}  // namespace sslcd
