// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "sslcd/closing/place_matcher.h"
#include "sslcd/core/fields.h"

namespace sslcd::baselines {

/// Appearance of whole images: a bag of binary words with tf-idf, and a check of the geometry by
/// PnP, in the manner of DBoW2 (D. Galvez-Lopez, J. D. Tardos, "Bags of Binary Words for Fast Place
/// Recognition in Image Sequences", T-RO 2012) and of the loop closure of VINS-Fusion and
/// ORB-SLAM3. The code is ours; docs/baselines.md says where it differs.
struct AppearanceOptions {
  int features = 2000;             ///< ORB features of an image
  int every = 2;                   ///< old images are kept from every so many frames
  int branching = 10, levels = 4;  ///< of the tree of words
  /// of the sequence itself, evenly over it, from which the words are learnt
  int training_images = 40;
  double least_similarity = 0.015;  ///< of the words of two images
  /// the most similar old images have their geometry checked, ...
  int candidates = 30;
  /// ... so many frames apart at least, for neighbours show the same
  int island = 2;
  /// a point further off says nothing about where a camera stands
  double max_depth_m = 50;
  int max_distance = 64;  ///< of two descriptors that match, in bits of 256
  double ratio = 0.9;     ///< ... and of the best to the second best
  double reprojection_px = 3;
  double search_px = 6;  ///< how far from where the pose has them points are searched for
  int least_inliers = 100;
  double max_turn_deg = 180;  ///< a loop turns the camera by no more than this, and ...
  double max_apart_m = 20;    ///< ... lies no further off
};
void DescribeFields(FieldVisitor& visitor, AppearanceOptions& options);

/// On a sequence folder with image_2, image_3 and calib.txt. Score: inliers of the PnP check, of
/// poses within the limits of turn and distance; taken from `least_inliers` on. The frames of the
/// queries are those of the folder. Images are read as they are asked for. Throws Error
/// (kBadInput): no calibration of two cameras, an image that cannot be read.
PlaceMatcher AppearanceMatcher(const std::string& folder, const AppearanceOptions& options);

}  // namespace sslcd::baselines
