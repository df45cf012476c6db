// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/image_features.h"

#include <cstring>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/imgcodecs.hpp>

#include "sslcd/core/error.h"

namespace sslcd::baselines {
namespace {

struct Detected {
  std::vector<cv::KeyPoint> points;
  std::vector<BinaryDescriptor> descriptors;
};

Detected Detect(const std::string& path, int count) {
  const cv::Mat image = cv::imread(path, cv::IMREAD_GRAYSCALE);
  if (image.empty())
    throw Error(ErrorKind::kBadInput, {path}, "no image that can be read; the appearance baseline needs all of them");
  Detected found;
  cv::Mat descriptors;
  cv::ORB::create(count)->detectAndCompute(image, cv::noArray(), found.points, descriptors);
  found.descriptors.resize(found.points.size());
  for (int i = 0; i < descriptors.rows; ++i)
    std::memcpy(found.descriptors[i].data(), descriptors.ptr(i), sizeof(BinaryDescriptor));
  return found;
}

// The disparity of a left feature: the most similar right feature on its row.
std::optional<double> Disparity(const cv::KeyPoint& left, const BinaryDescriptor& descriptor, const Detected& right,
                                int max_distance) {
  constexpr float kRow = 2.f, kMaxDisparity = 200.f;  // [px]
  int least = max_distance + 1;
  std::optional<double> best;
  for (std::size_t j = 0; j < right.points.size(); ++j) {
    const cv::KeyPoint& other = right.points[j];
    const float disparity = left.pt.x - other.pt.x;
    if (std::abs(left.pt.y - other.pt.y) > kRow || disparity < 0.5f || disparity > kMaxDisparity) continue;
    const int distance = HammingDistance(descriptor, right.descriptors[j]);
    if (distance < least) least = distance, best = disparity;
  }
  return best;
}

// Index of the feature of `among` that is surely the same as `descriptor`; -1: none.
int Match(const BinaryDescriptor& descriptor, const std::vector<BinaryDescriptor>& among,
          const AppearanceOptions& options) {
  int best = -1, first = std::numeric_limits<int>::max(), second = first;
  for (std::size_t j = 0; j < among.size(); ++j) {
    const int distance = HammingDistance(descriptor, among[j]);
    if (distance < first)
      second = first, first = distance, best = static_cast<int>(j);
    else
      second = std::min(second, distance);
  }
  return first <= options.max_distance && first < options.ratio * second ? best : -1;
}

}  // namespace

ImageFeatures ExtractFeatures(const std::string& left, const std::string& right, const Camera& camera,
                              double baseline_m, const AppearanceOptions& options) {
  const Detected in_left = Detect(left, options.features), in_right = Detect(right, options.features);
  ImageFeatures features;
  features.descriptors = in_left.descriptors;
  for (std::size_t i = 0; i < in_left.points.size(); ++i) {
    const cv::Point2f& p = in_left.points[i].pt;
    features.pixels.push_back({p.x, p.y});
    const auto disparity = Disparity(in_left.points[i], in_left.descriptors[i], in_right, options.max_distance);
    std::optional<Vec3>& point = features.points.emplace_back();
    if (!disparity) continue;
    const double depth = camera.fx * baseline_m / *disparity;
    point = depth * Vec3((p.x - camera.cx) / camera.fx, (p.y - camera.cy) / camera.fy, 1);
  }
  return features;
}

std::optional<ImagePose> PoseFromImages(const ImageFeatures& query, const ImageFeatures& old, const Camera& camera,
                                        const AppearanceOptions& options) {
  std::vector<cv::Point3d> points;
  std::vector<cv::Point2d> pixels;
  for (std::size_t i = 0; i < old.descriptors.size(); ++i) {
    if (!old.points[i]) continue;
    const int j = Match(old.descriptors[i], query.descriptors, options);
    if (j < 0) continue;
    points.emplace_back(old.points[i]->x(), old.points[i]->y(), old.points[i]->z());
    pixels.emplace_back(query.pixels[j].x(), query.pixels[j].y());
  }
  constexpr std::size_t kLeast = 6;  // for a pose at all
  if (points.size() < kLeast) return std::nullopt;
  const cv::Matx33d K(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
  cv::Mat rotation, translation;
  std::vector<int> inliers;
  if (!cv::solvePnPRansac(points, pixels, K, cv::noArray(), rotation, translation, false, 300,
                          static_cast<float>(options.reprojection_px), 0.99, inliers))
    return std::nullopt;
  const Vec3 axis(rotation.at<double>(0), rotation.at<double>(1), rotation.at<double>(2));
  const Vec3 t(translation.at<double>(0), translation.at<double>(1), translation.at<double>(2));
  return ImagePose{Pose(lie::SO3<double>::Exp(axis), t).inverse(), static_cast<int>(inliers.size())};
}

}  // namespace sslcd::baselines
