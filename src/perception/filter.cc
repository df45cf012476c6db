// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/perception/filter.h"

#include <algorithm>
#include <cmath>

namespace sslcd {
namespace {

bool IsFinite(const Detection& detection) {
  const double* pose = detection.T_cam_object.data();
  return std::isfinite(detection.score) && detection.dims.allFinite() &&
         std::all_of(pose, pose + Pose::kParameters,
                     [](double value) { return std::isfinite(value); });
}

bool HasRightSize(const Vec3& dims, const DetectionFilterOptions& options) {
  return (dims.array() >= options.min_size_m).all() && (dims.array() <= options.max_size_m).all();
}

/// The counter of this detection.
int& Classify(const Detection& detection, const DetectionFilterOptions& options,
              FilterReport& report) {
  if (!IsFinite(detection)) return report.not_finite;
  if (detection.score < options.min_score) return report.low_score;
  if (detection.T_cam_object.translation().norm() > options.max_range_m) return report.too_far;
  if (!HasRightSize(detection.dims, options)) return report.wrong_size;
  return report.kept;
}

}  // namespace

FilterReport& FilterReport::operator+=(const FilterReport& other) {
  kept += other.kept;
  not_finite += other.not_finite;
  low_score += other.low_score;
  too_far += other.too_far;
  wrong_size += other.wrong_size;
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
}

}  // namespace sslcd
