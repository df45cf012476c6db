// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/image_features.h"

#include <cmath>
#include <cstring>
#include <opencv2/features2d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/video/tracking.hpp>

#include "sslcd/core/error.h"

namespace sslcd::baselines {
namespace {

cv::Mat Read(const std::string& path) {
  cv::Mat image = cv::imread(path, cv::IMREAD_GRAYSCALE);
  if (image.empty())
    throw Error(ErrorKind::kBadInput, {path},
                "no image that can be read; the appearance baseline needs all of them");
  return image;
}

// The disparity of each feature of the left image; none: not found in the right one.
std::vector<std::optional<double>> Disparities(const cv::Mat& left, const cv::Mat& right,
                                               const std::vector<cv::Point2f>& pixels) {
  constexpr float kBackPx = 0.5f, kRowPx = 1.f, kLeastPx = 0.5f;
  std::vector<std::optional<double>> disparities(pixels.size());
  if (pixels.empty()) return disparities;
  std::vector<cv::Point2f> there, back;
  std::vector<unsigned char> found, found_back;
  cv::calcOpticalFlowPyrLK(left, right, pixels, there, found, cv::noArray());
  cv::calcOpticalFlowPyrLK(right, left, there, back, found_back, cv::noArray());
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const cv::Point2f shift = pixels[i] - there[i], loss = pixels[i] - back[i];
    const bool sure = found[i] && found_back[i] && std::hypot(loss.x, loss.y) < kBackPx &&
                      std::abs(shift.y) < kRowPx;
    if (sure && shift.x > kLeastPx) disparities[i] = shift.x;
  }
  return disparities;
}

}  // namespace

ImageFeatures ExtractFeatures(const std::string& left, const std::string& right,
                              const StereoCamera& stereo, const AppearanceOptions& options) {
  const Camera& camera = stereo.left;
  const cv::Mat in_left = Read(left), in_right = Read(right);
  if (in_left.size() != in_right.size())
    throw Error(ErrorKind::kBadInput, {right},
                "has not the size of " + left + "; both must be rectified alike");
  const auto orb = cv::ORB::create(options.features);
  std::vector<cv::KeyPoint> found;
  orb->detect(in_left, found);
  for (cv::KeyPoint& point : found) point.angle = 0;  // upright
  cv::Mat descriptors;
  orb->compute(in_left, found, descriptors);
  std::vector<cv::Point2f> pixels;
  cv::KeyPoint::convert(found, pixels);
  const auto disparities = Disparities(in_left, in_right, pixels);

  ImageFeatures features;
  features.descriptors.resize(pixels.size());
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const cv::Point2f& p = pixels[i];
    features.pixels.push_back({p.x, p.y});
    std::memcpy(features.descriptors[i].data(), descriptors.ptr(static_cast<int>(i)),
                sizeof(BinaryDescriptor));
    std::optional<Vec3>& point = features.points.emplace_back();
    if (!disparities[i]) continue;
    const double disparity = *disparities[i] - stereo.disparity_at_infinity;
    const double depth = camera.fx * stereo.baseline_m / disparity;
    if (!(disparity > 0) || depth > options.max_depth_m) continue;
    point = depth * Vec3((p.x - camera.cx) / camera.fx, (p.y - camera.cy) / camera.fy, 1);
  }
  return features;
}

}  // namespace sslcd::baselines
