// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/image_pyramids.h"

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

#include "stereo/grey.h"

namespace sslcd {
namespace {

// All set by hand.
constexpr int kMaxLevel = 4;                    // sizes from 1 to 1/16
constexpr double kReturnsWithin = 1;            // [px] from the start, there and back
constexpr float kBesidePx = 1.5F;               // start of the way back, from the solution
constexpr int kTrackSteps = 30;                 // of Lucas-Kanade on a level
constexpr double kTrackDonePx = 0.01;           // step at which it has converged
constexpr int kSurroundings = 3;                // width for mean and deviation, in patches
constexpr double kMidGrey = 128, kSpread = 40;  // mean and deviation of a normalised image
constexpr double kNoise = 4;  // smaller deviations are noise and are not amplified

// Copies the image, since the host may overwrite its own while a keyframe needs it.
ImagePyramid Build(const cv::Mat& grey, int patch_px) {
  ImagePyramid pyramid;
  cv::buildOpticalFlowPyramid(grey, pyramid, {patch_px, patch_px}, kMaxLevel, true,
                              cv::BORDER_REFLECT_101, cv::BORDER_CONSTANT, false);
  return pyramid;
}

}  // namespace

StereoPyramids BuildPyramids(const StereoView& images, int patch_px) {
  return {Build(Grey(images.left), patch_px), Build(Grey(images.right), patch_px),
          cv::Size(images.left.width, images.left.height)};
}

ImagePyramid NormaliseContrast(const ImagePyramid& image, int patch_px) {
  const cv::Size surroundings(kSurroundings * patch_px, kSurroundings * patch_px);
  cv::Mat grey, mean, square, deviation, evened;
  image[0].convertTo(grey, CV_32F);
  cv::boxFilter(grey, mean, CV_32F, surroundings);
  cv::sqrBoxFilter(grey, square, CV_32F, surroundings);
  cv::sqrt(cv::max(square - mean.mul(mean), 0), deviation);
  cv::Mat(kMidGrey + kSpread * (grey - mean) / (deviation + kNoise)).convertTo(evened, CV_8U);
  return Build(evened, patch_px);
}

TrackedPoints TrackPoints(const ImagePyramid& from, const ImagePyramid& to,
                          const std::vector<cv::Point2f>& points,
                          const std::vector<cv::Point2f>& guess, int levels, int patch_px) {
  TrackedPoints result{guess, std::vector<bool>(points.size())};
  if (points.empty()) return result;
  std::vector<unsigned char> status;
  const cv::TermCriteria until(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, kTrackSteps,
                               kTrackDonePx);
  cv::calcOpticalFlowPyrLK(from, to, points, result.at, status, cv::noArray(), {patch_px, patch_px},
                           levels, until, cv::OPTFLOW_USE_INITIAL_FLOW, kMinEigenvalue);
  const cv::Rect2f inside(0, 0, static_cast<float>(to[0].cols), static_cast<float>(to[0].rows));
  for (std::size_t i = 0; i < points.size(); ++i)
    result.found[i] = status[i] && inside.contains(result.at[i]);
  return result;
}

TrackedPoints TrackForthAndBack(const ImagePyramid& from, const ImagePyramid& to,
                                const std::vector<cv::Point2f>& points,
                                const std::vector<cv::Point2f>& guess, int levels, int patch_px) {
  TrackedPoints there = TrackPoints(from, to, points, guess, levels, patch_px);
  std::vector<cv::Point2f> begin = points;
  // Starts the way back beside the solution, or a patch that has not moved would always return.
  for (cv::Point2f& p : begin) p += cv::Point2f(kBesidePx, kBesidePx);
  const TrackedPoints back = TrackPoints(to, from, there.at, begin, 0, patch_px);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const cv::Point2f off = back.at[i] - points[i];
    there.found[i] = there.found[i] && back.found[i] && std::hypot(off.x, off.y) <= kReturnsWithin;
  }
  return there;
}

}  // namespace sslcd
