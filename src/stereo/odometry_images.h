// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>
#include <vector>

#include "sslcd/core/image.h"
#include "sslcd/stereo/odometry.h"

namespace sslcd {

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

/// The strongest corner (smaller eigenvalue of the gradients' covariance: Shi and Tomasi, Good
/// features to track, CVPR 1994) of each cell of a grid of about `cells` cells that has none of the
/// points `taken` in it. In the order of the cells, row by row; between pixels, and less than a
/// patch off its cell.
std::vector<cv::Point2f> SpreadCorners(const StereoPyramids& images,
                                       const std::vector<cv::Point2f>& taken, int cells,
                                       int patch_px);

}  // namespace sslcd
