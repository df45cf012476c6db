// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>
#include <vector>

#include "sslcd/core/image.h"

namespace sslcd {

/// Pyramid levels for a search without and with a good guess.
inline constexpr int kCoarse = 4, kFine = 1;

/// Smallest eigenvalue of a patch (OpenCV's, per pixel); noise alone has less.
inline constexpr double kMinEigenvalue = 1e-4;

/// An image pyramid for Lucas-Kanade. Copies share their pixels.
using ImagePyramid = std::vector<cv::Mat>;

/// The pyramids of a stereo pair. Copies the pixels.
struct StereoPyramids {
  ImagePyramid left, right;
  cv::Size size;
};
/// `patch_px`: side of the patches to track.
StereoPyramids BuildPyramids(const StereoView& images, int patch_px);

/// Normalises brightness and contrast by the local mean and deviation, against changes of light.
ImagePyramid NormaliseContrast(const ImagePyramid& image, int patch_px);

/// Tracks points from one image to another. `guess` has the start positions. With `levels` pyramid
/// levels a patch may move by about 2^levels * patch_px / 2 pixels.
struct TrackedPoints {
  std::vector<cv::Point2f> at;
  std::vector<bool> found;
};
TrackedPoints TrackPoints(const ImagePyramid& from, const ImagePyramid& to,
                          const std::vector<cv::Point2f>& points,
                          const std::vector<cv::Point2f>& guess, int levels, int patch_px);

/// Tracks forth and back. A point is found only if it returns to its start.
TrackedPoints TrackForthAndBack(const ImagePyramid& from, const ImagePyramid& to,
                                const std::vector<cv::Point2f>& points,
                                const std::vector<cv::Point2f>& guess, int levels, int patch_px);

}  // namespace sslcd
