// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "sslcd/closing/place_matcher.h"
#include "sslcd/core/fields.h"

namespace sslcd::baselines {

/// Place recognition by whole images: a bag of binary words with tf-idf, and geometric verification
/// by PnP, like DBoW2 (D. Galvez-Lopez, J. D. Tardos, "Bags of Binary Words for Fast Place
/// Recognition in Image Sequences", T-RO 2012) and of the loop closure of VINS-Fusion and
/// ORB-SLAM3. An own implementation; docs/baselines.md lists the differences.
struct AppearanceOptions {
  int features = 2000;             ///< number of ORB features per image
  int every = 2;                   ///< keeps the image of every n-th frame
  int branching = 10, levels = 4;  ///< shape of the vocabulary tree
  /// number of training images of the vocabulary, evenly spread over the sequence
  int training_images = 40;
  double least_similarity = 0.015;  ///< smallest similarity of the words of two images
  /// number of the most similar old images with geometric verification
  int candidates = 30;
  /// smallest number of frames between two of them
  int island = 2;
  /// largest distance of a point: farther ones do not measure the translation
  double max_depth_m = 50;
  int max_distance = 64;  ///< largest distance of two matching descriptors, in bits of 256
  double ratio = 0.9;     ///< largest ratio of the best to the second best distance
  double reprojection_px = 3;
  double search_px = 6;  ///< radius of the search for points around their prediction
  int least_inliers = 100;
  double max_turn_deg = 180;  ///< largest rotation of a loop
  double max_apart_m = 20;    ///< largest translation of a loop
};
void DescribeFields(FieldVisitor& visitor, AppearanceOptions& options);

/// Makes a matcher for a sequence folder with image_2, image_3 and calib.txt. The score is the
/// number of PnP inliers of poses within the limits of rotation and translation; at least
/// `least_inliers` are accepted. The frame numbers of the queries are those of the folder. Reads
/// images on demand. Throws Error(kBadInput) without the calibration of two cameras, or if an image
/// cannot be read.
PlaceMatcher AppearanceMatcher(const std::string& folder, const AppearanceOptions& options);

}  // namespace sslcd::baselines
