// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "sslcd/core/camera.h"
#include "sslcd/core/detection.h"
#include "sslcd/core/detection_noise.h"
#include "sslcd/core/fields.h"
#include "sslcd/core/image.h"
#include "sslcd/ground/ground_plane.h"

namespace sslcd {

/// Usual size and outline of the objects of a class.
struct ClassPrior {
  double length_m = 4.3, width_m = 1.8, height_m = 1.55;
  double length_sigma_m = 0.4, width_sigma_m = 0.1, height_sigma_m = 0.12;
  /// from either end to where it stands on the ground (axle), share of the length
  double overhang = 0.18;
  double roof = 0.5;  ///< the part of it that is as high as the object, share of the length
};
void DescribeFields(FieldVisitor& visitor, ClassPrior& prior);

/// Of road users in Europe. config/classes.yaml holds the same.
std::map<std::string, ClassPrior> UsualClasses();

struct LiftOptions {
  /// by label; boxes of other labels are not lifted. LoadClasses (frontend) reads others.
  std::map<std::string, ClassPrior> classes = UsualClasses();
  GroundOptions ground;
  double min_range_m = 2, max_range_m = 40;  ///< from the camera to the object's visible side
  double min_height_px = 14;                 ///< boxes that are less high are not lifted
  double max_yaw_sigma_rad = 0.8;  ///< boxes whose yaw has a larger standard deviation are rejected
  /// standard deviation of a box's sides, share of its width or height, on top of 2 px; a coarse
  /// detector's, whose description has it (ModelOutput::box_sigma). 0: boxes are tight
  double box_sigma_share = 0;
};
void DescribeFields(FieldVisitor& visitor, LiftOptions& options);

/// What became of a box.
enum class LiftStatus {
  kLifted,
  kUnknownLabel,  ///< no prior for the class
  kBadBox,        ///< not finite, without area, outside of the image
  kTooSmall,      ///< less high than min_height_px
  kNoDepth,       ///< too few pixels of an object whose disparity is known: no texture, sky, hidden
  kOutOfRange,    ///< nearer than min_range_m or further than max_range_m
  kPoorFit,       ///< no cuboid of the class explains box and disparities
  kAmbiguous,     ///< several headings do, see max_yaw_sigma_rad
};
const char* ToString(LiftStatus status);

/// A box and, where `status` is kLifted or kAmbiguous, the cuboid that it shows.
struct LiftedBox {
  LiftStatus status = LiftStatus::kBadBox;
  /// label, score, box of the image detection; pose in the reference camera, yaw modulo pi
  Detection detection;
  // Of the fit, the other headings that explain what is seen included; LiftNoise() is what to
  // expect on average.
  DetectionSigmas sigmas;    ///< of the position in the ray's frame, and of the yaw [m, rad]
  Vec3 dims_sigma{0, 0, 0};  ///< of length, width, height [m]
  /// of the position in the camera's axes [m^2]
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

/// What a mapper should take such detections' noise for: measured on rendered images at a baseline
/// of 12 cm (docs/notes, "Cuboids from stereo images"). The mapper learns a factor on each
/// component; with another baseline it has to.
DetectionNoise LiftNoise();

/// Cuboids from 2D boxes and a rectified pair, one answer a box and in its order. For each box:
/// semi-global matching inside of it, the contour of the lower body by columns (as a laser scanner
/// would see it), and the cuboid that best explains contour, the sides of the box, the ground and
/// the class' usual size, by least squares from twelve headings. What one side does not show (the
/// length, seen from behind) is the prior's. Front and back are not told apart.
///
/// Sides at the image's border, and those where a nearer box begins, only say that the object
/// reaches so far at least. Boxes are lifted from the nearest to the furthest: a nearer object
/// tells which pixels are its own, and where nothing else can stand. The order of the boxes changes
/// nothing.
///
/// Never throws for a box. Throws Error(kBadInput) for images as CheckImages does, and for images
/// of another size than the camera's, where that is known.
std::vector<LiftedBox> LiftBoxes(const StereoView& images, const StereoCamera& camera,
                                 const std::vector<ImageDetection>& boxes,
                                 const LiftOptions& options);

}  // namespace sslcd
