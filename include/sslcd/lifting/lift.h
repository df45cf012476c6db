// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "sslcd/core/camera.h"
#include "sslcd/core/detection.h"
#include "sslcd/core/detection_noise.h"
#include "sslcd/core/export.h"
#include "sslcd/core/fields.h"
#include "sslcd/core/image.h"
#include "sslcd/ground/ground_plane.h"

namespace SSLCD_EXPORT sslcd {

/// Usual size and outline of the objects of a class: means and standard deviations.
struct ClassPrior {
  double length_m = 4.3, width_m = 1.8, height_m = 1.55;                    ///< mean size
  double length_sigma_m = 0.4, width_sigma_m = 0.1, height_sigma_m = 0.12;  ///< its scatter
  /// distance of the axles from either end, share of the length
  double overhang = 0.18;
  double roof = 0.5;  ///< length of the part that has the full height, share of the length
};
void DescribeFields(FieldVisitor& visitor, ClassPrior& prior);

/// The classes of road users in Europe, the same as in config/classes.yaml.
std::map<std::string, ClassPrior> UsualClasses();

struct LiftOptions {
  /// by label; boxes of other labels are not lifted. LoadClasses (frontend) reads them from a file.
  std::map<std::string, ClassPrior> classes = UsualClasses();
  GroundOptions ground;
  /// distance from the camera to the object's visible side
  double min_range_m = 2, max_range_m = 40;
  double min_height_px = 14;       ///< boxes of a smaller height are not lifted
  double max_yaw_sigma_rad = 0.8;  ///< boxes whose yaw has a larger standard deviation are rejected
  /// standard deviation of a box's sides, share of its width or height, added to 2 px. The
  /// description of a coarse detector sets it (ModelOutput::box_sigma). 0: boxes are tight
  double box_sigma_share = 0;
};
void DescribeFields(FieldVisitor& visitor, LiftOptions& options);

/// The result of lifting a box.
enum class LiftStatus {
  kLifted,
  kUnknownLabel,  ///< no prior for the class
  kBadBox,        ///< not finite, without area, outside of the image
  kTooSmall,      ///< its height is smaller than min_height_px
  kNoDepth,       ///< too few pixels with a disparity: no texture, sky, occluded
  kOutOfRange,    ///< nearer than min_range_m or farther than max_range_m
  kPoorFit,       ///< no cuboid of the class explains box and disparities
  kAmbiguous,     ///< several headings explain them, see max_yaw_sigma_rad
};
const char* ToString(LiftStatus status);

/// A box and, if `status` is kLifted or kAmbiguous, its cuboid.
struct LiftedBox {
  LiftStatus status = LiftStatus::kBadBox;
  /// label, score, box of the image detection; pose in the reference camera, yaw modulo pi
  Detection detection;
  // Uncertainties of the fit, including other headings that also explain the box. LiftNoise() has
  // their usual size.
  DetectionSigmas sigmas;    ///< of the position in the ray's frame, and of the yaw [m, rad]
  Vec3 dims_sigma{0, 0, 0};  ///< of length, width, height [m]
  /// of the position in the camera's axes [m^2]
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

/// The noise of lifted detections for a mapper, measured on rendered images with a baseline of 12
/// cm (docs/notes, "Cuboids from stereo images"). The mapper learns a factor on each component,
/// which other baselines require.
DetectionNoise LiftNoise();

/// Lifts 2D boxes to cuboids by a rectified stereo pair. Returns one answer per box, in the order
/// of the boxes. For each box it runs semi-global matching inside the box and extracts the contour
/// of the lower body by columns, like a laser scanner. Then it fits a cuboid to the contour, the
/// sides of the box, the ground and the usual size of the class, by least squares from twelve
/// headings. Dimensions that are not visible (the length, seen from behind) come from the class.
/// Front and back are not distinguished.
/// Sides at the image's border, or at the edge of a nearer box, only bound the object from inside.
/// Boxes are lifted from the nearest to the farthest: a nearer object takes its pixels and its
/// ground. The results do not depend on the order of the boxes.
/// Never throws for a box. Throws the errors of CheckImages, and Error(kBadInput) if the images
/// differ in size from the camera's, if that is known.
std::vector<LiftedBox> LiftBoxes(const StereoView& images, const StereoCamera& camera,
                                 const std::vector<ImageDetection>& boxes,
                                 const LiftOptions& options);

}  // namespace sslcd
