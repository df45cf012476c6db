// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>
#include <vector>

#include "sslcd/core/image.h"

namespace sslcd {

/// Levels to look through: for anything, for what is nearly known.
inline constexpr int kCoarse = 4, kFine = 1;

/// Smallest eigenvalue that a patch must have (of OpenCV's, per pixel): what noise alone has.
inline constexpr double kMinEigenvalue = 1e-4;

/// A grey image in several sizes, as Lucas-Kanade wants it. Copies share their pixels.
using ImagePyramid = std::vector<cv::Mat>;

/// A pair of images, ready to be followed through. Holds copies of the pixels.
struct StereoPyramids {
  ImagePyramid left, right;
  cv::Size size;
};
/// `patch_px`: side of the patches that will be followed.
StereoPyramids BuildPyramids(const StereoView& images, int patch_px);

/// The same image with brightness and contrast evened out, by mean and deviation of each pixel's
/// surroundings: what remains of a scene when the light changes.
ImagePyramid Evened(const ImagePyramid& image, int patch_px);

/// Where points of one image are in another. `guess` is where to begin to look, `levels` how
/// coarse: the patch may be off by some 2^levels * patch_px / 2 pixels.
struct Followed {
  std::vector<cv::Point2f> at;
  std::vector<bool> found;
};
Followed Follow(const ImagePyramid& from, const ImagePyramid& to,
                const std::vector<cv::Point2f>& points, const std::vector<cv::Point2f>& guess,
                int levels, int patch_px);

/// The same, and back again: found only if that leads to where it began.
Followed FollowThereAndBack(const ImagePyramid& from, const ImagePyramid& to,
                            const std::vector<cv::Point2f>& points,
                            const std::vector<cv::Point2f>& guess, int levels, int patch_px);

}  // namespace sslcd
