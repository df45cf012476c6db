// SPDX-License-Identifier: BSD-3-Clause
#include <map>
#include <opencv2/calib3d.hpp>
#include <opencv2/features2d.hpp>
#include <utility>

#include "baselines/image_features.h"

namespace sslcd::baselines {
namespace {

constexpr std::size_t kLeast = 6;  // smallest number of matches of a pose

struct Pair {
  int old = -1, query = -1, distance = 0;
};

cv::Mat AsMat(const std::vector<BinaryDescriptor>& descriptors) {
  return {static_cast<int>(descriptors.size()), static_cast<int>(sizeof(BinaryDescriptor)), CV_8U,
          const_cast<BinaryDescriptor*>(descriptors.data())};
}

// Mutual nearest neighbours of old features with a point and features of the query that pass the
// ratio test.
std::vector<Pair> Match(const ImageFeatures& query, const ImageFeatures& old,
                        const AppearanceOptions& options) {
  if (query.descriptors.empty() || old.descriptors.empty()) return {};
  const cv::BFMatcher matcher(cv::NORM_HAMMING);
  std::vector<std::vector<cv::DMatch>> of_old;
  std::vector<cv::DMatch> of_query;
  matcher.knnMatch(AsMat(old.descriptors), AsMat(query.descriptors), of_old, 2);
  matcher.match(AsMat(query.descriptors), AsMat(old.descriptors), of_query);
  std::vector<Pair> pairs;
  for (const std::vector<cv::DMatch>& nearest : of_old) {
    const cv::DMatch& first = nearest[0];
    const bool unlike_others =
        nearest.size() < 2 ||
        first.distance < static_cast<float>(options.ratio) * nearest[1].distance;
    if (old.points[first.queryIdx] && unlike_others &&
        first.distance <= static_cast<float>(options.max_distance) &&
        of_query[first.trainIdx].trainIdx == first.queryIdx)
      pairs.push_back({first.queryIdx, first.trainIdx, static_cast<int>(first.distance)});
  }
  return pairs;
}

// A pose in OpenCV's convention: T_query_old.
class Resection {
 public:
  Resection(const ImageFeatures& query, const ImageFeatures& old, const Camera& camera,
            const AppearanceOptions& options)
      : query_(query),
        old_(old),
        options_(options),
        K_(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1),
        camera_(camera) {}

  // P3P in RANSAC.
  bool Find(const std::vector<Pair>& pairs) {
    Take(pairs);
    if (points_.size() < kLeast) return false;
    std::vector<int> inliers;
    if (!cv::solvePnPRansac(points_, pixels_, K_, cv::noArray(), rotation_, translation_, false,
                            kSamples, static_cast<float>(options_.reprojection_px), 0.999, inliers,
                            cv::SOLVEPNP_AP3P))
      return false;
    return Refine();
  }

  // Matches old points with the most similar feature around their prediction in the query's image,
  // one to one.
  std::vector<Pair> Search() const {
    const Pose T_query_old = T_old_query().inverse();
    std::map<int, Pair> of_query;
    for (std::size_t i = 0; i < old_.points.size(); ++i) {
      if (!old_.points[i]) continue;
      const Vec3 point = T_query_old * *old_.points[i];
      if (point.z() < kNearestM) continue;
      const Vec2 pixel(camera_.fx * point.x() / point.z() + camera_.cx,
                       camera_.fy * point.y() / point.z() + camera_.cy);
      Pair best{static_cast<int>(i), -1, options_.max_distance + 1};
      for (std::size_t j = 0; j < query_.pixels.size(); ++j) {
        if ((query_.pixels[j] - pixel).cwiseAbs().maxCoeff() > options_.search_px) continue;
        const int distance = HammingDistance(old_.descriptors[i], query_.descriptors[j]);
        if (distance < best.distance) {
          best.query = static_cast<int>(j);
          best.distance = distance;
        }
      }
      if (best.query < 0) continue;
      const auto [taken, is_new] = of_query.insert({best.query, best});
      if (!is_new && best.distance < taken->second.distance) taken->second = best;
    }
    std::vector<Pair> pairs;
    for (const auto& [index, pair] : of_query) pairs.push_back(pair);
    return pairs;
  }

  // Refines the pose over its inliers.
  bool Improve(const std::vector<Pair>& pairs) {
    Take(pairs);
    return Refine();
  }

  Pose T_old_query() const {
    const Vec3 axis(rotation_.at<double>(0), rotation_.at<double>(1), rotation_.at<double>(2));
    const Vec3 t(translation_.at<double>(0), translation_.at<double>(1),
                 translation_.at<double>(2));
    return Pose(lie::SO3<double>::Exp(axis), t).inverse();
  }
  int inliers() const { return static_cast<int>(Agreeing().size()); }

 private:
  static constexpr int kSamples = 2000, kRounds = 2;
  static constexpr double kNearestM = 0.5;

  void Take(const std::vector<Pair>& pairs) {
    points_.clear();
    pixels_.clear();
    for (const Pair& pair : pairs) {
      const Vec3& point = *old_.points[pair.old];
      points_.emplace_back(point.x(), point.y(), point.z());
      pixels_.emplace_back(query_.pixels[pair.query].x(), query_.pixels[pair.query].y());
    }
  }

  std::vector<int> Agreeing() const {
    std::vector<int> agreeing;
    if (points_.empty()) return agreeing;
    std::vector<cv::Point2d> projected;
    cv::projectPoints(points_, rotation_, translation_, K_, cv::noArray(), projected);
    for (std::size_t i = 0; i < projected.size(); ++i)
      if (cv::norm(projected[i] - pixels_[i]) < options_.reprojection_px)
        agreeing.push_back(static_cast<int>(i));
    return agreeing;
  }

  bool Refine() {
    for (int round = 0; round < kRounds; ++round) {
      std::vector<cv::Point3d> points;
      std::vector<cv::Point2d> pixels;
      for (const int i : Agreeing()) {
        points.push_back(points_[i]);
        pixels.push_back(pixels_[i]);
      }
      if (points.size() < kLeast) return false;
      cv::solvePnPRefineLM(points, pixels, K_, cv::noArray(), rotation_, translation_);
    }
    return true;
  }

  const ImageFeatures &query_, &old_;
  const AppearanceOptions& options_;
  cv::Matx33d K_;
  Camera camera_;
  std::vector<cv::Point3d> points_;  // points of the current matches
  std::vector<cv::Point2d> pixels_;
  cv::Mat rotation_, translation_;
};

}  // namespace

std::optional<ImagePose> PoseFromImages(const ImageFeatures& query, const ImageFeatures& old,
                                        const Camera& camera, const AppearanceOptions& options) {
  constexpr int kSearches = 2;
  Resection resection(query, old, camera, options);
  if (!resection.Find(Match(query, old, options))) return std::nullopt;
  for (int i = 0; i < kSearches; ++i)
    if (!resection.Improve(resection.Search())) return std::nullopt;
  return ImagePose{resection.T_old_query(), resection.inliers()};
}

}  // namespace sslcd::baselines
