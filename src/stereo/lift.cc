// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/stereo/lift.h"

#include <algorithm>
#include <cmath>

#include "sslcd/core/error.h"
#include "stereo/cuboid_fit.h"
#include "stereo/grey.h"
#include "stereo/ground_search.h"

namespace sslcd {
namespace {

bool IsFinite(const Box2d& box) {
  return std::isfinite(box.left) && std::isfinite(box.top) && std::isfinite(box.right) && std::isfinite(box.bottom);
}

Box2d Clipped(const Box2d& box, const ImageView& image) {
  return {std::max(box.left, 0.), std::max(box.top, 0.), std::min<double>(box.right, image.width - 1),
          std::min<double>(box.bottom, image.height - 1)};
}

double Overlap(double low_a, double high_a, double low_b, double high_b) {
  return std::max(0., std::min(high_a, high_b) - std::max(low_a, low_b));
}

/// On flat ground, the one whose lower side is further down.
bool IsNearer(const Box2d& box, const Box2d& than) { return box.bottom > than.bottom; }

/// Sides at the image's border, and those where a box begins that stands nearer.
BoxSides OpenSides(const Box2d& box, const std::vector<Box2d>& all, const ImageView& image, double tolerance_px) {
  constexpr double kShare = 0.25;  // of a side, hidden
  BoxSides open;
  open.left_open = box.left < tolerance_px;
  open.top_open = box.top < tolerance_px;
  open.right_open = box.right > image.width - 1 - tolerance_px;
  open.bottom_open = box.bottom > image.height - 1 - tolerance_px;
  for (const Box2d& other : all) {
    if (!IsNearer(other, box)) continue;
    const bool beside = Overlap(box.top, box.bottom, other.top, other.bottom) > kShare * (box.bottom - box.top);
    const bool below = Overlap(box.left, box.right, other.left, other.right) > kShare * (box.right - box.left);
    const auto covers = [&](double u) { return u > other.left - tolerance_px && u < other.right + tolerance_px; };
    open.left_open |= beside && covers(box.left);
    open.right_open |= beside && covers(box.right);
    open.bottom_open |= below && other.top < box.bottom;
  }
  return open;
}

/// Fine for what is small in the image, coarse for what is large: about as many pixels for each box.
DisparityPatch Match(const GreyPair& grey, const Box2d& box, double max_disparity) {
  const double height = box.bottom - box.top;
  const double scale = height > 240 ? 0.5 : 1;
  const double pad = 4;
  return MatchInside(grey, {box.left - pad, box.top - pad, box.right + pad, box.bottom + pad}, max_disparity,
                     height < 80 ? 2 : scale, scale);
}

/// Below the glass, above what lies on the ground; no deeper than a side seen at an angle.
ScanRules RulesFor(const ClassPrior& prior) {
  ScanRules rules;
  rules.low_m = 0.12 * prior.height_m;
  rules.high_m = 0.62 * prior.height_m;
  rules.depth_m = prior.length_m;
  return rules;
}

LiftedBox Finish(const CuboidFit& fit, const ImageDetection& image, const StereoCamera& camera) {
  LiftedBox lifted;
  lifted.status = LiftStatus::kLifted;
  lifted.detection.label = image.label;
  lifted.detection.score = image.score;
  lifted.detection.box = image.box;
  const Vec3 centre = fit.T_cam_object.translation();
  lifted.detection.T_cam_object = Pose(fit.T_cam_object.rotation(), centre - camera.left.offset);
  lifted.detection.dims = fit.dims;
  lifted.covariance = fit.covariance;
  const Eigen::Matrix3d rows = RayFrame(centre);
  const Vec3 variance = (rows * fit.covariance * rows.transpose()).diagonal().cwiseMax(0);
  lifted.sigmas = {std::sqrt(variance.x()), std::sqrt(variance.y()), std::sqrt(variance.z()), fit.yaw_sigma};
  lifted.dims_sigma = fit.dims_sigma;
  return lifted;
}

}  // namespace

std::vector<LiftedBox> LiftBoxes(const StereoView& images, const StereoCamera& camera,
                                 const std::vector<ImageDetection>& boxes, const LiftOptions& options) {
  CheckImages(images);
  const GreyPair grey{Grey(images.left), Grey(images.right)};
  const double bf = camera.baseline_m * camera.left.fx;
  std::vector<LiftedBox> lifted(boxes.size());
  std::vector<Box2d> usable;
  for (const ImageDetection& box : boxes) {
    if (IsFinite(box.box)) usable.push_back(Clipped(box.box, images.left));
  }
  const GroundPlane ground = EstimateGround(grey, camera, usable, options.ground);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const auto prior = options.classes.find(boxes[i].label);
    const Box2d box = Clipped(boxes[i].box, images.left);
    if (prior == options.classes.end()) {
      lifted[i].status = LiftStatus::kUnknownLabel;
      continue;
    }
    if (!IsFinite(boxes[i].box) || !(box.Area() > 0)) continue;
    if (box.bottom - box.top < options.min_height_px) {
      lifted[i].status = LiftStatus::kTooSmall;
      continue;
    }
    const DisparityPatch patch = Match(grey, box, bf / options.min_range_m);
    FitInput input{box, OpenSides(box, usable, images.left, options.box_sigma_px), {}, prior->second};
    std::vector<Box2d> nearer;
    for (const Box2d& other : usable) {
      if (IsNearer(other, box)) nearer.push_back(other);
    }
    input.scan = ScanObject(patch, box, nearer, camera, ground, RulesFor(prior->second));
    if (input.scan.size() < 4) {
      lifted[i].status = LiftStatus::kNoDepth;
      continue;
    }
    const std::optional<CuboidFit> fit = FitCuboid(input, camera, ground, options);
    if (!fit) {
      lifted[i].status = LiftStatus::kPoorFit;
      continue;
    }
    lifted[i] = Finish(*fit, boxes[i], camera);
  }
  return lifted;
}

}  // namespace sslcd
