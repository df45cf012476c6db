// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/lifting/lift.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "ground/ground_search.h"
#include "lifting/cuboid_fit.h"
#include "sslcd/core/error.h"
#include "stereo/grey.h"

namespace sslcd {
namespace {

bool IsFinite(const Box2d& box) {
  return std::isfinite(box.left) && std::isfinite(box.top) && std::isfinite(box.right) &&
         std::isfinite(box.bottom);
}

Box2d Clipped(const Box2d& box, const ImageView& image) {
  return {std::max(box.left, 0.), std::max(box.top, 0.),
          std::min<double>(box.right, image.width - 1),
          std::min<double>(box.bottom, image.height - 1)};
}

double Overlap(double low_a, double high_a, double low_b, double high_b) {
  return std::max(0., std::min(high_a, high_b) - std::max(low_a, low_b));
}

/// Opens the sides at the image's border and at the edges of nearer boxes.
BoxSides OpenSides(const Box2d& box, const std::vector<Nearer>& nearer, const ImageView& image,
                   const Box2d& sigmas) {
  constexpr double kShare = 0.25;  // smallest occluded share of a side; set by hand
  BoxSides open;
  open.left_open = box.left < sigmas.left;
  open.top_open = box.top < sigmas.top;
  open.right_open = box.right > image.width - 1 - sigmas.right;
  open.bottom_open = box.bottom > image.height - 1 - sigmas.bottom;
  // The part beyond the left or right border may be nearer and thus extend farther up and down.
  if (open.left_open || open.right_open) open.top_open = open.bottom_open = true;
  for (const Nearer& object : nearer) {
    const Box2d& other = object.box;
    const bool beside =
        Overlap(box.top, box.bottom, other.top, other.bottom) > kShare * (box.bottom - box.top);
    const bool below =
        Overlap(box.left, box.right, other.left, other.right) > kShare * (box.right - box.left);
    const auto covers = [&](double u) {
      return u > other.left - sigmas.left && u < other.right + sigmas.right;
    };
    open.left_open |= beside && covers(box.left);
    open.right_open |= beside && covers(box.right);
    open.bottom_open |= below && other.top < box.bottom;
  }
  return open;
}

/// Scales small boxes up and large ones down, so that all have a similar number of pixels.
DisparityPatch Match(const GreyPair& grey, const Box2d& box, double max_disparity) {
  const double height = box.bottom - box.top;
  // [px] Heights of boxes above which half the resolution suffices, and below which twice the
  // columns, interpolated, give more. Not tuned.
  constexpr double kLarge = 240, kSmall = 80;
  constexpr double kPad = 4;                       // [px] margin of the matcher beside the box
  const double scale = height > kLarge ? 0.5 : 1;  // half the resolution, or all of it
  return MatchInside(grey, {box.left - kPad, box.top - kPad, box.right + kPad, box.bottom + kPad},
                     max_disparity, height < kSmall ? 2 : scale, scale);
}

/// Range of heights between clutter on the ground and glass; depth of a side seen at an angle.
ScanRules RulesFor(const ClassPrior& prior) {
  // Shares of the height, chosen for cars: bumpers begin at 0.12, glass at 0.62. Other classes use
  // the same. Not tuned.
  constexpr double kLow = 0.12, kHigh = 0.62;
  ScanRules rules;
  rules.low_m = kLow * prior.height_m;
  rules.high_m = kHigh * prior.height_m;
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
  lifted.sigmas = {std::sqrt(variance.x()), std::sqrt(variance.y()), std::sqrt(variance.z()),
                   fit.yaw_sigma};
  lifted.dims_sigma = fit.dims_sigma;
  return lifted;
}

/// Data of a frame that all boxes use.
struct Scene {
  const ImageView& image;
  const GreyPair& grey;
  const StereoCamera& camera;
  const GroundFrame& ground;
  const LiftOptions& options;
};

/// Checks of a box that need no pixels.
std::optional<LiftStatus> Refusal(const ImageDetection& detection, const Box2d& box,
                                  const LiftOptions& options) {
  if (options.classes.count(detection.label) == 0) return LiftStatus::kUnknownLabel;
  if (!IsFinite(detection.box) || !(box.Area() > 0)) return LiftStatus::kBadBox;
  if (!(box.bottom - box.top >= options.min_height_px)) return LiftStatus::kTooSmall;
  return std::nullopt;
}

/// Standard deviations of the sides of a box.
Box2d SigmasOf(const Box2d& box, const LiftOptions& options) {
  // [px] for a good detector; the published figures have 2 px of noise on each side (docs/notes,
  // "Cuboids from stereo images").
  constexpr double kTight = 2;
  const double x = std::hypot(kTight, options.box_sigma_share * (box.right - box.left));
  const double y = std::hypot(kTight, options.box_sigma_share * (box.bottom - box.top));
  return {x, y, x, y};
}

/// Enlarges a coarse box to the possible extent of its object.
Box2d Around(const Box2d& box, const Box2d& sigmas, const ImageView& image) {
  constexpr double kSigmas = 2;  // 95 % of a Gaussian
  return Clipped({box.left - kSigmas * sigmas.left, box.top - kSigmas * sigmas.top,
                  box.right + kSigmas * sigmas.right, box.bottom + kSigmas * sigmas.bottom},
                 image);
}

/// Fuses two measurements of a side.
void Merge(double at, double sigma_px, double& side, double& side_sigma_px) {
  const double weight = 1 / (sigma_px * sigma_px),
               side_weight = 1 / (side_sigma_px * side_sigma_px);
  side = (weight * at + side_weight * side) / (weight + side_weight);
  side_sigma_px = 1 / std::sqrt(weight + side_weight);
}

/// Refines the sides of a coarse box by the ends of the contour. If the contour has gaps, the part
/// with most points in the box belongs to the object.
void TakeSidesOfContour(const Box2d& around, FitInput& input) {
  // Shares of the box's width: largest gap (windows, no texture), and standard deviation of the
  // ends of a contour. Set by hand.
  constexpr double kGap = 0.25, kSigma = 0.05;
  const Box2d box = input.box;
  const double width = box.right - box.left;
  const auto inside = [&](const ScanPoint& point) {
    return point.u >= box.left && point.u <= box.right;
  };
  auto first = input.scan.begin(), best_first = first, best_last = first;
  std::ptrdiff_t most = -1;
  for (auto at = first; at != input.scan.end(); ++at) {
    const auto next = at + 1;
    if (next != input.scan.end() && next->u - at->u < kGap * width) continue;
    const std::ptrdiff_t count = std::count_if(first, next, inside);
    if (count > most) {
      most = count;
      best_first = first;
      best_last = next;
    }
    first = next;
  }
  input.scan = {best_first, best_last};
  // A contour that reaches the border of the searched area has no known end.
  const double left = input.scan.front().u, right = input.scan.back().u, sigma = kSigma * width;
  if (!input.sides.left_open && left > around.left + sigma)
    Merge(left, sigma, input.box.left, input.sigmas.left);
  if (!input.sides.right_open && right < around.right - sigma)
    Merge(right, sigma, input.box.right, input.sigmas.right);
}

/// Lifts a box, or returns the reason of the failure.
LiftStatus Lift(const Scene& scene, const Box2d& box, const std::vector<Nearer>& nearer,
                const ClassPrior& prior, CuboidFit& answer) {
  // The cost of a column that does not belong to the object; limits of the errors of a fit
  // [sigmas]. Set by hand.
  constexpr double kElsewhere = 1;
  constexpr double kBoxError = 5, kScanError = 2.5;
  const double max_disparity =
      scene.camera.baseline_m * scene.camera.left.fx / scene.options.min_range_m;
  const bool coarse = scene.options.box_sigma_share > 0;
  const Box2d sigmas = SigmasOf(box, scene.options);
  const Box2d around = coarse ? Around(box, sigmas, scene.image) : box;
  const auto scans = ScanObject(Match(scene.grey, around, max_disparity), around, nearer,
                                scene.camera, scene.ground, RulesFor(prior));
  if (scans.empty()) return LiftStatus::kNoDepth;
  FitInput input;
  input.prior = prior;
  input.sides = OpenSides(box, nearer, scene.image, sigmas);
  for (const Nearer& other : nearer) {
    if (other.footprint) input.taken.push_back(*other.footprint);
  }
  std::optional<CuboidFit> best;
  double least = 0;
  for (const std::vector<ScanPoint>& scan : scans) {
    input.box = box;
    input.sigmas = sigmas;
    input.scan = scan;
    if (coarse) TakeSidesOfContour(around, input);
    if (input.scan.size() < ScanRules().fewest) continue;
    const std::optional<CuboidFit> fit = FitCuboid(input, scene.camera, scene.ground);
    if (!fit) continue;
    const double cost = fit->cost - kElsewhere * static_cast<double>(input.scan.size());
    if (best && cost >= least) continue;
    best = fit;
    least = cost;
  }
  if (!best || best->box_error > kBoxError || best->scan_error > kScanError)
    return LiftStatus::kPoorFit;
  const double range = best->T_cam_object.translation().norm();
  if (!(range >= scene.options.min_range_m && range <= scene.options.max_range_m))
    return LiftStatus::kOutOfRange;
  answer = *best;
  return LiftStatus::kLifted;
}

}  // namespace

std::vector<LiftedBox> LiftBoxes(const StereoView& images, const StereoCamera& camera,
                                 const std::vector<ImageDetection>& boxes,
                                 const LiftOptions& options) {
  const GreyPair grey = GreyOf(images, camera);
  CheckSize(images.left, camera.left);
  std::vector<LiftedBox> lifted(boxes.size());
  std::vector<std::size_t> order;
  std::vector<Box2d> clipped(boxes.size());
  std::vector<Box2d> objects;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    clipped[i] = Clipped(boxes[i].box, images.left);
    if (IsFinite(clipped[i]) && clipped[i].Area() > 0) objects.push_back(clipped[i]);
    const std::optional<LiftStatus> refusal = Refusal(boxes[i], clipped[i], options);
    lifted[i].detection.label = boxes[i].label;
    if (refusal) lifted[i].status = *refusal;
    if (!refusal) order.push_back(i);
  }
  const GroundFrame ground(EstimateGround(grey, camera, objects, options.ground));
  const Scene scene{images.left, grey, camera, ground, options};
  // Nearest first (lowest in the image on flat ground), since near objects occlude far ones.
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return clipped[a].bottom > clipped[b].bottom;
  });
  std::vector<Nearer> nearer;
  for (std::size_t i : order) {
    CuboidFit fit;
    lifted[i].status = Lift(scene, clipped[i], nearer, options.classes.at(boxes[i].label), fit);
    nearer.push_back({clipped[i], fit.scan, std::nullopt});
    if (lifted[i].status != LiftStatus::kLifted) continue;
    nearer.back().footprint = fit.footprint;
    lifted[i] = Finish(fit, boxes[i], camera);
    if (fit.yaw_sigma > options.max_yaw_sigma_rad) lifted[i].status = LiftStatus::kAmbiguous;
  }
  return lifted;
}

}  // namespace sslcd
