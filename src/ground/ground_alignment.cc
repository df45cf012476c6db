// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/ground/ground_alignment.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "ground/ground_patches.h"
#include "stereo/bundle.h"
#include "stereo/geometry.h"
#include "stereo/grey.h"
#include "stereo/image_pyramids.h"
#include "stereo/patch_alignment.h"

namespace sslcd {
namespace {

// Smallest number of consistent patches, and their smallest share of the patches that both cameras
// see. Chosen on rendered HALV-sim and KITTI 02 and 06; guesses with errors of 5 m gave no wrong
// answer (docs/notes, "From images alone").
constexpr int kMinPatches = 25;
constexpr double kMinShare = 0.15;

/// Corresponding pixels of both left images.
struct CommonGround {
  Pose motion;
  std::vector<cv::Point2f> in_a, in_b;
};

/// None: too few consistent patches.
std::optional<CommonGround> FindCommonGround(const GroundView& a, const GroundView& b,
                                             const StereoCamera& camera, Pose motion) {
  constexpr double kCell = 0.03;  // [m] of the top views; set by hand
  // largest error of the guess in each round; set by hand
  constexpr int kSearchCells[] = {5, 3, 3};
  const GroundGrid grid = GridOf(kCell);
  const TopView from = SeeFromAbove(a.grey, camera.left, a.T_cam_ground, grid);
  CommonGround common;
  for (const int search : kSearchCells) {
    const Pose T_b_ground = b.T_cam_ground * motion.inverse();
    const TopView to = SeeFromAbove(b.grey, camera.left, T_b_ground, grid);
    int tried = 0;
    std::vector<GroundPair> pairs = MatchPatches(from, to, grid, search, tried);
    const double needed = std::max<double>(kMinPatches, kMinShare * tried);
    if (static_cast<double>(pairs.size()) < needed) return std::nullopt;
    motion = OnGround(FitMotion(pairs) * motion);
    if (static_cast<double>(pairs.size()) < needed) return std::nullopt;
    common = {motion, {}, {}};
    const auto pixel = [&](const Vec3& p) {
      const StereoPixel at = ProjectStereo(camera, p);
      return ToCv(at.left, at.row);
    };
    for (const GroundPair& pair : pairs) {
      common.in_a.push_back(pixel(a.T_cam_ground * pair.in_a));
      common.in_b.push_back(pixel(T_b_ground * pair.in_b));
    }
  }
  return common;
}

/// The ground point at a pixel of the left image.
Vec3 PlaceOnGround(const StereoCamera& camera, const GroundPlane& plane, const cv::Point2f& left) {
  const Vec3 ray((left.x - camera.left.cx) / camera.left.fx,
                 (left.y - camera.left.cy) / camera.left.fy, 1);
  return ray * (-plane.height_m / plane.up.dot(ray));
}

/// The pixel of that point in the right image, to a fraction of a pixel.
std::optional<cv::Point2f> FindInRight(const StereoPyramids& images, const StereoCamera& camera,
                                       const GroundPlane& plane, const cv::Point2f& left,
                                       const cv::Point2f& guess) {
  constexpr int kHalf = 7;  // [px] half the width of a patch; set by hand
  const Vec3 point = PlaceOnGround(camera, plane, left);
  const Pose T_right_left = Pose::Trans(-camera.baseline_m, 0, 0);
  const auto homography = PlaneHomography(camera.left, T_right_left, point, plane.up);
  if (!homography) return std::nullopt;
  const auto found =
      AlignPatch({images.left[0], left, point, kHalf}, *homography, images.right[0], guess);
  if (!found) return std::nullopt;
  return found->at;
}

/// Ground points in one stereo pair.
struct PairView {
  GroundPlane plane;
  std::vector<Vec3> places;  ///< on the plane
  std::vector<StereoPixel> pixels;
};

/// Finds the pixels of ground points in both images of a pair, given their pixels in the left one.
PairView InBothImages(const StereoView& images, const StereoCamera& camera,
                      const GroundPlane& plane, const std::vector<cv::Point2f>& left) {
  // [px] larger than the odometry's, since near texture is weak; 9 was worse, 21 no better
  // (docs/notes, "From images alone").
  constexpr int kGroundPatchPx = 15;
  const StereoPyramids pyramids = BuildPyramids(images, kGroundPatchPx);
  PairView view{plane, {}, {}};
  std::vector<cv::Point2f> guess = left;
  for (cv::Point2f& p : guess) {
    view.places.push_back(PlaceOnGround(camera, plane, p));
    p.x = static_cast<float>(ProjectStereo(camera, view.places.back()).right);
  }
  const TrackedPoints right =
      TrackPoints(pyramids.left, pyramids.right, left, guess, kFine, kGroundPatchPx);
  for (std::size_t i = 0; i < left.size(); ++i) {
    std::optional<cv::Point2f> at;
    if (right.found[i]) at = FindInRight(pyramids, camera, plane, left[i], right.at[i]);
    const bool found = at && IsPair(camera, left[i], *at);
    view.pixels.push_back({left[i].x, left[i].y, found ? at->x : NAN});
  }
  return view;
}

// Standard deviation of a patch at best. Set by hand. [px]
constexpr double kLeastPx = 0.1;

/// Weights by the noise of the left pixel. The right column is searched from there, so it has the
/// same error plus that of the disparity.
Eigen::Matrix3d WeightBy(double column_px, double row_px) {
  // Standard deviation. 0.1 on rendered images; on KITTI 0.1 is worse (docs/notes, "From images
  // alone").
  constexpr double kDisparityPx = 0.15;
  Eigen::Matrix3d weight;
  weight << 1 / column_px, 0, 0,  //
      0, 1 / row_px, 0,           //
      1 / kDisparityPx, 0, -1 / kDisparityPx;
  return weight;
}

/// Ground patches match to half a pixel of the farther view. Returns that error in pixels of this
/// view, which has the patch `here` metres ahead, the other one `there`.
Eigen::Matrix3d WeightOfPatch(const StereoCamera& camera, double height_m, double here,
                              double there) {
  // Standard deviation, after the true depths of rendered images (docs/notes, "From images alone").
  constexpr double kPatchPx = 0.5;
  const double off_m = kPatchPx * std::max(here, there) / camera.left.fx;
  return WeightBy(std::hypot(kLeastPx, off_m * camera.left.fx / here),
                  std::hypot(kLeastPx, off_m * camera.left.fy * height_m / (here * here)));
}

/// Estimates the pose T_a_b of the left cameras from all four images, starting at `guess`. None:
/// too few points.
std::optional<RelativePose> AdjustPose(const PairView& in_a, const PairView& in_b,
                                       const StereoCamera& camera, const Pose& guess) {
  StereoFrame a, b{guess, {}};
  OdometryPoints points;
  for (int i = 0; i < static_cast<int>(in_a.pixels.size()); ++i) {
    const StereoPixel &pixel_a = in_a.pixels[i], &pixel_b = in_b.pixels[i];
    const bool placed_by_a = !std::isnan(pixel_a.right);
    if (!placed_by_a && std::isnan(pixel_b.right)) continue;
    points[i] =
        placed_by_a ? Triangulate(camera, pixel_a) : Vec3(guess * Triangulate(camera, pixel_b));
    a.sightings.push_back(
        {i, pixel_a, WeightBy(kLeastPx, kLeastPx)});  // the points are defined by these pixels
    b.sightings.push_back(
        {i, pixel_b,
         WeightOfPatch(camera, in_b.plane.height_m, in_b.places[i].z(), in_a.places[i].z())});
  }
  if (static_cast<int>(points.size()) < kMinPatches) return std::nullopt;
  constexpr double kLoss = 2;  // standard deviations; set by hand
  RefineWindow(camera, 1, {&a, &b}, kLoss, points);
  // Patches overlap, so errors of neighbours correlate. The noise is that of the weights, or that
  // of the residuals if it is larger.
  // Factor on the covariance. 1.5 fits rendered images; real ones ask for more (docs/notes, "From
  // images alone").
  constexpr double kAlike = 2.5;
  const double noise = std::max(
      {1., ResidualScale(camera, a, points).z(), ResidualScale(camera, b, points).maxCoeff()});
  return RelativePose{b.T_odom_left, kAlike * StepCovariance(camera, a, b, points, noise)};
}

}  // namespace

void DescribeFields(FieldVisitor& visitor, GroundAlignmentOptions& options) {
  visitor.Real("search_m", options.search_m, 0.06, 5,
               "largest error of the guess in each direction; a larger search leaves less ground "
               "to compare");
  visitor.Real("max_sigma_m", options.max_sigma_m, 0, 100,
               "alignments whose position has a larger standard deviation are rejected");
}

std::optional<double> AlignmentRange(const Camera& camera, int rows, double height_m) {
  // Length of the ground that both cameras should see, and largest distance of its near end. Set by
  // hand. [m]
  constexpr double kCommon = 7, kFarthest = 12;
  const double below = (rows - camera.cy) / camera.fy, nearest = height_m / below;
  if (!(below > 0) || nearest > kFarthest) return std::nullopt;
  return nearest + 0.5 * kCommon;
}

std::optional<RelativePose> AlignGround(const StereoView& a, const StereoView& b,
                                        const StereoCamera& camera, const Pose& T_a_b_guess,
                                        const GroundOptions& ground,
                                        const GroundAlignmentOptions& options) {
  for (const StereoView* view : {&a, &b}) CheckSize(view->left, camera.left);
  const GroundPlane plane_a = EstimateGround(a, camera, {}, ground),
                    plane_b = EstimateGround(b, camera, {}, ground);
  if (std::min(plane_a.support, plane_b.support) < kGroundSupport) return std::nullopt;
  const GroundView view_a{Grey(a.left), LevelOn(plane_a)}, view_b{Grey(b.left), LevelOn(plane_b)};
  const Pose T_left_ref = Pose::Trans(camera.left.offset);
  const Pose T_ref_ground_a = T_left_ref.inverse() * view_a.T_cam_ground;
  const Pose T_ref_ground_b = T_left_ref.inverse() * view_b.T_cam_ground;
  const Pose guess = OnGround(T_ref_ground_a.inverse() * T_a_b_guess * T_ref_ground_b);
  std::optional<CommonGround> common = FindCommonGround(view_a, view_b, camera, guess);
  if (!common) {  // the guess has a larger error than the search range of a patch
    const std::optional<Pose> motion = FindMotion(view_a, view_b, camera, guess, options.search_m);
    if (motion) common = FindCommonGround(view_a, view_b, camera, *motion);
  }
  if (!common) return std::nullopt;
  const Pose by_planes = view_a.T_cam_ground * common->motion * view_b.T_cam_ground.inverse();
  const std::optional<RelativePose> left =
      AdjustPose(InBothImages(a, camera, plane_a, common->in_a),
                 InBothImages(b, camera, plane_b, common->in_b), camera, by_planes);
  if (!left || !(std::sqrt(left->covariance.topLeftCorner<3, 3>().trace()) <= options.max_sigma_m))
    return std::nullopt;
  // Exp(d) in the left camera's axes is Exp(Adj(T_ref_left) d) in the reference camera's.
  const Pose::Matrix6 adjoint = T_left_ref.inverse().Adj();
  return RelativePose{T_left_ref.inverse() * left->T_a_b * T_left_ref,
                      adjoint * left->covariance * adjoint.transpose()};
}

}  // namespace sslcd
