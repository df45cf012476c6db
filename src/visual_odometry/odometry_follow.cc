// SPDX-License-Identifier: BSD-3-Clause
#include "visual_odometry/odometry_follow.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>

#include "stereo/patch_alignment.h"

namespace sslcd {
namespace {

constexpr int kCoarsePoints = 120;  // enough for a coarse pose; set by hand
// RANSAC draws of four points. With an inlier share of 0.4 one draw is good with 99.4 %
// probability.
constexpr int kRansacTrials = 200;
constexpr double kRansacConfidence = 0.999;  // stops the draws early; set by hand
// Smallest share of inliers among the tracked points. Set by hand.
constexpr double kMinInliers = 0.3;
constexpr double kMinDepth = 0.1;  // [m] in front of the camera; set by hand

const char* const kNoAgreement = "the points found again do not agree on a pose";

/// Points of the reference keyframe and their predictions in another image.
struct PredictedPixels {
  std::vector<int> points;
  std::vector<cv::Point2f> from, to;
  std::vector<double> disparities;
};

/// Predicts points of the reference keyframe from a camera pose: about `count` points inside the
/// image.
PredictedPixels PredictPixels(const TrackedKeyframe& f, const cv::Size& size,
                              const Pose& T_odom_left, int about) {
  const StereoFrame& reference = f.keyframe;
  const Pose T_left_odom = T_odom_left.inverse();
  const std::size_t each = std::max<std::size_t>(1, reference.sightings.size() / about);
  PredictedPixels predicted;
  for (std::size_t i = 0; i < reference.sightings.size(); i += each) {
    const StereoSighting& sighting = reference.sightings[i];
    const Vec3 point = T_left_odom * f.points.at(sighting.point);
    if (!(point.z() > kMinDepth)) continue;
    const StereoPixel pixel = ProjectStereo(f.camera, point);
    if (!(pixel.left > 0 && pixel.row > 0 && pixel.left < size.width && pixel.row < size.height))
      continue;
    predicted.points.push_back(sighting.point);
    predicted.from.push_back(ToCv(sighting.pixel.left, sighting.pixel.row));
    predicted.to.push_back(ToCv(pixel.left, pixel.row));
    predicted.disparities.push_back(pixel.left - pixel.right);
  }
  return predicted;
}

}  // namespace

std::optional<Pose> FindPose(const TrackedKeyframe& f, const ImagePyramid& from,
                             const ImagePyramid& to, const Pose& T_guess, const char*& reason) {
  const PredictedPixels predicted = PredictPixels(f, to[0].size(), T_guess, kCoarsePoints);
  const TrackedPoints followed =
      TrackPoints(from, to, predicted.from, predicted.to, kCoarse, kPatchPx);
  const StereoFrame& reference = f.keyframe;
  const Pose T_reference_odom = reference.T_odom_left.inverse();
  std::vector<cv::Point3d> places;
  std::vector<cv::Point2d> pixels;
  for (std::size_t i = 0; i < predicted.points.size(); ++i) {
    if (!followed.found[i]) continue;
    const Vec3 place = T_reference_odom * f.points.at(predicted.points[i]);
    places.emplace_back(place.x(), place.y(), place.z());
    pixels.emplace_back(followed.at[i]);
  }
  reason = kTooFewFound;
  if (static_cast<int>(places.size()) < kMinTracked) return std::nullopt;

  const Camera& left = f.camera.left;
  const cv::Matx33d K(left.fx, 0, left.cx, 0, left.fy, left.cy, 0, 0, 1);
  cv::Vec3d rotation, translation;
  std::vector<int> inliers;
  reason = kNoAgreement;
  // Uses its own generator with a fixed seed; OpenCV's global one belongs to the host.
  const bool found = cv::solvePnPRansac(places, pixels, K, cv::noArray(), rotation, translation,
                                        false, kRansacTrials, static_cast<float>(kFitsWithinPx),
                                        kRansacConfidence, inliers, cv::SOLVEPNP_AP3P);
  const double needed = std::max<double>(kMinTracked, kMinInliers * places.size());
  if (!found || inliers.size() < needed) return std::nullopt;
  const Pose T_left_reference(lie::SO3<double>::Exp(Vec3(rotation[0], rotation[1], rotation[2])),
                              Vec3(translation[0], translation[1], translation[2]));
  return reference.T_odom_left * T_left_reference.inverse();
}

StereoFrame FindAll(const TrackedKeyframe& f, const ImagePyramid& from, const ImagePyramid& to,
                    const StereoPyramids& current, const Pose& T_odom_left) {
  const PredictedPixels predicted =
      PredictPixels(f, to[0].size(), T_odom_left, std::numeric_limits<int>::max());
  TrackedPoints left = TrackForthAndBack(from, to, predicted.from, predicted.to, kFine, kPatchPx);
  const Pose T_keyframe_odom = f.keyframe.T_odom_left.inverse();
  const Pose T_left_keyframe = T_odom_left.inverse() * f.keyframe.T_odom_left;
  for (std::size_t i = 0; i < left.at.size(); ++i) {
    if (!left.found[i]) continue;
    const Vec3 point = T_keyframe_odom * f.points.at(predicted.points[i]);
    const Patch patch{from[0], predicted.from[i], point, kPatchPx / 2};
    const std::optional<cv::Point2f> at =
        FindPatch(patch, f.camera.left, T_left_keyframe, to[0], left.at[i]);
    left.found[i] = at.has_value();
    if (at) left.at[i] = *at;
  }
  std::vector<cv::Point2f> guess = left.at;
  for (std::size_t i = 0; i < guess.size(); ++i)
    guess[i].x -= static_cast<float>(predicted.disparities[i]);
  const TrackedPoints right =
      TrackPoints(current.left, current.right, left.at, guess, kFine, kPatchPx);
  StereoFrame frame{T_odom_left, {}};
  for (std::size_t i = 0; i < left.at.size(); ++i) {
    if (!left.found[i]) continue;
    std::optional<StereoPixel> pair;
    if (right.found[i]) pair = MeasurePair(f.camera, current, left.at[i], right.at[i]);
    frame.sightings.push_back(
        {predicted.points[i], pair.value_or(StereoPixel{left.at[i].x, left.at[i].y, NAN})});
  }
  return frame;
}

std::optional<StereoPixel> MeasurePair(const StereoCamera& camera, const StereoPyramids& images,
                                       const cv::Point2f& left, const cv::Point2f& right) {
  if (!IsPair(camera, left, right)) return std::nullopt;
  const Patch patch{images.left[0], left, Triangulate(camera, {left.x, left.y, right.x}),
                    kPatchPx / 2};
  const Pose T_right_left = Pose::Trans(-camera.baseline_m, 0, 0);
  const std::optional<cv::Point2f> at =
      FindPatch(patch, camera.left, T_right_left, images.right[0], right);
  if (!at || !IsPair(camera, left, *at)) return std::nullopt;
  return StereoPixel{left.x, left.y, at->x};
}

}  // namespace sslcd
