// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/stereo/ground_alignment.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "stereo/grey.h"
#include "stereo/odometry_follow.h"
#include "stereo/top_view.h"

namespace sslcd {
namespace {

/// An image, and where its camera stands above its own ground.
struct GroundView {
  cv::Mat grey;
  Pose T_cam_ground;
};

/// Of a pose between two ground frames, what a camera can do that stays on the ground: shift and heading.
Pose OnGround(const Pose& T) {
  const Vec3 ahead = T.so3() * Vec3(Vec3::UnitZ());
  return Pose::Trans(T.translation().x(), 0, T.translation().z()) * Pose::RotY(std::atan2(ahead.x(), ahead.z()));
}

GroundGrid GridOf(const GroundAlignmentOptions& options, double cell) {
  return {-options.half_width_m, options.near_m, cell, static_cast<int>(2 * options.half_width_m / cell),
          static_cast<int>((options.far_m - options.near_m) / cell)};
}

/// Calls use(patch, scores) for each patch of the first view that both views show, its surroundings in the second one
/// included. `scores`: correlation [-1, 1] for shifts of up to `search` cells each way.
template <class Use>
void ForEachPatch(const TopView& from, const TopView& to, int half, int search, const Use& use) {
  const auto all_seen = [](const cv::Mat& seen) { return cv::countNonZero(seen) == seen.rows * seen.cols; };
  const int margin = half + search, side = 2 * half + 1;
  for (int row = margin; row < from.grey.rows - margin; row += half) {
    for (int column = margin; column < from.grey.cols - margin; column += half) {
      const cv::Rect patch(column - half, row - half, side, side);
      const cv::Rect around(column - margin, row - margin, side + 2 * search, side + 2 * search);
      if (!all_seen(from.seen(patch)) || !all_seen(to.seen(around))) continue;
      cv::Mat scores;
      cv::matchTemplate(to.grey(around), from.grey(patch), scores, cv::TM_CCOEFF_NORMED);
      use(patch, scores);
    }
  }
}

/// The motion T_a_b, near `guess`, at which all patches together fit best: to a cell. A coarse view: what is looked for
/// is large.
std::optional<Pose> FindMotion(const GroundView& a, const GroundView& b, const StereoCamera& camera, const Pose& guess,
                               const GroundAlignmentOptions& options) {
  constexpr double kCell = 0.06, kTurn = 0.01;
  constexpr int kHalf = 7, kFewest = 5;
  const GroundGrid grid = GridOf(options, kCell);
  const int search = static_cast<int>(std::ceil(options.search_m / kCell));
  const int turns = static_cast<int>(std::ceil(options.search_rad / kTurn));
  const Pose to_middle = Pose::Trans(0, 0, 0.5 * (options.near_m + options.far_m));
  const TopView from = SeeFromAbove(a.grey, camera.left, a.T_cam_ground, grid);
  std::optional<Pose> best;
  double highest = 0;
  for (int k = -turns; k <= turns; ++k) {
    const Pose turned = to_middle * Pose::RotY(k * kTurn) * to_middle.inverse() * guess;
    const TopView to = SeeFromAbove(b.grey, camera.left, b.T_cam_ground * turned.inverse(), grid);
    cv::Mat sum(2 * search + 1, 2 * search + 1, CV_32F, cv::Scalar(0));
    int count = 0;
    ForEachPatch(from, to, kHalf, search, [&](const cv::Rect&, const cv::Mat& scores) { sum += scores, ++count; });
    if (count < kFewest) continue;
    double score = 0;
    cv::Point at;
    cv::minMaxLoc(sum, nullptr, &score, nullptr, &at);
    if (score / count <= highest) continue;
    highest = score / count;
    best = Pose::Trans(-kCell * (at.x - search), 0, -kCell * (at.y - search)) * turned;
  }
  return best;
}

/// A place on the ground as the first view has it, and where the second one shows the same. [m]
struct GroundPair {
  Vec3 in_a, in_b;
};

/// Where the parabola through three values has its top, from the middle one.
double Top(double before, double here, double after) { return 0.5 * (before - after) / (before - 2 * here + after); }

/// `tried`: patches that both show.
std::vector<GroundPair> MatchPatches(const TopView& from, const TopView& to, const GroundGrid& grid, int search,
                                     int& tried) {
  constexpr int kHalf = 20;
  constexpr double kMinScore = 0.5;
  std::vector<GroundPair> pairs;
  ForEachPatch(from, to, kHalf, search, [&](const cv::Rect& patch, const cv::Mat& scores) {
    ++tried;
    double score = 0;
    cv::Point at;
    cv::minMaxLoc(scores, nullptr, &score, nullptr, &at);
    const cv::Rect inner(1, 1, scores.cols - 2, scores.rows - 2);
    if (score < kMinScore || !inner.contains(at)) return;
    const auto near = [&](int x, int y) { return static_cast<double>(scores.at<float>(at.y + y, at.x + x)); };
    const double x = at.x - search + Top(near(-1, 0), near(0, 0), near(1, 0));
    const double y = at.y - search + Top(near(0, -1), near(0, 0), near(0, 1));
    const int column = patch.x + kHalf, row = patch.y + kHalf;
    pairs.push_back({grid.At(column, row), grid.At(column + x, row + y)});
  });
  return pairs;
}

/// The motion on the ground that takes in_b to in_a: least squares with Geman and McClure's weights. Keeps the pairs
/// that agree.
Pose FitMotion(std::vector<GroundPair>& pairs) {
  constexpr double kScale = 0.02, kAgree = 0.05;  // [m]
  constexpr int kRounds = 10;
  Pose motion;
  std::vector<double> weights(pairs.size(), 1);
  for (int round = 0; round < kRounds; ++round) {
    double sum = 0, sine = 0, cosine = 0;
    Vec3 middle_a(0, 0, 0), middle_b(0, 0, 0);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      sum += weights[i];
      middle_a += weights[i] * pairs[i].in_a;
      middle_b += weights[i] * pairs[i].in_b;
    }
    middle_a /= sum, middle_b /= sum;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const Vec3 p = pairs[i].in_a - middle_a, q = pairs[i].in_b - middle_b;
      cosine += weights[i] * q.dot(p);
      sine += weights[i] * q.cross(p).y();
    }
    motion = Pose::Trans(middle_a) * Pose::RotY(std::atan2(sine, cosine)) * Pose::Trans(-middle_b);
    for (std::size_t i = 0; i < pairs.size(); ++i)
      weights[i] = 1 / (1 + std::pow((motion * pairs[i].in_b - pairs[i].in_a).norm() / kScale, 2));
  }
  const auto differs = [&](const GroundPair& pair) { return (motion * pair.in_b - pair.in_a).norm() >= kAgree; };
  pairs.erase(std::remove_if(pairs.begin(), pairs.end(), differs), pairs.end());
  return motion;
}

/// The same places in both views: pixels of both left images.
struct CommonGround {
  Pose motion;
  std::vector<cv::Point2f> in_a, in_b;
};

/// None: too few patches agree.
std::optional<CommonGround> FindCommonGround(const GroundView& a, const GroundView& b, const StereoCamera& camera,
                                             Pose motion, const GroundAlignmentOptions& options) {
  constexpr double kCell = 0.03;
  const GroundGrid grid = GridOf(options, kCell);
  const TopView from = SeeFromAbove(a.grey, camera.left, a.T_cam_ground, grid);
  CommonGround common;
  for (const int search : {5, 3, 3}) {
    const Pose T_b_ground = b.T_cam_ground * motion.inverse();
    const TopView to = SeeFromAbove(b.grey, camera.left, T_b_ground, grid);
    int tried = 0;
    std::vector<GroundPair> pairs = MatchPatches(from, to, grid, search, tried);
    const double needed = std::max<double>(options.min_patches, options.min_share * tried);
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

/// Places on the ground by their pixels in the left image, looked for in the right one.
StereoFrame SeenByBoth(const StereoView& images, const StereoCamera& camera, const GroundPlane& plane,
                       const std::vector<cv::Point2f>& left) {
  StereoOdometryOptions options;
  options.patch_px = 15;  // seen from so near, and so weak in texture
  const StereoPyramids pyramids = BuildPyramids(images, options);
  std::vector<cv::Point2f> guess = left;
  for (cv::Point2f& p : guess) {
    const Vec3 ray((p.x - camera.left.cx) / camera.left.fx, (p.y - camera.left.cy) / camera.left.fy, 1);
    p.x += static_cast<float>(camera.left.fx * camera.baseline_m * plane.up.dot(ray) / plane.height_m);
  }
  const Followed right = Follow(pyramids.left, pyramids.right, left, guess, kFine, options);
  StereoFrame frame;
  for (std::size_t i = 0; i < left.size(); ++i)
    if (right.found[i] && IsPair(left[i], right.at[i], options))
      frame.sightings.push_back({static_cast<int>(i), {left[i].x, left[i].y, right.at[i].x}});
  return frame;
}

}  // namespace

void DescribeFields(FieldVisitor& visitor, GroundAlignmentOptions& options) {
  visitor.Real("near_m", options.near_m, 0.5, 1000, "the ground looked at: from so far ahead of the first camera ...");
  visitor.Real("far_m", options.far_m, 1, 1000, "... to so far");
  visitor.Real("half_width_m", options.half_width_m, 0.5, 100, "... and so far to either side");
  visitor.Real("search_m", options.search_m, 0.06, 5, "how far off the guess may be, in each direction ...");
  visitor.Real("search_rad", options.search_rad, 0, 0.5, "... and in heading");
  visitor.Integer("min_patches", options.min_patches, 3, 10000, "so many patches of ground must agree ...");
  visitor.Real("min_share", options.min_share, 0, 1, "... and this share of those that both see");
  visitor.Real("max_sigma_m", options.max_sigma_m, 0, 100, "found only if its place is known this well");
}

std::optional<RelativePose> AlignGround(const StereoView& a, const StereoView& b, const StereoCamera& camera,
                                        const Pose& T_a_b_guess, const GroundOptions& ground,
                                        const GroundAlignmentOptions& options) {
  const GroundPlane plane_a = EstimateGround(a, camera, {}, ground), plane_b = EstimateGround(b, camera, {}, ground);
  if (std::min(plane_a.support, plane_b.support) < kGroundSupport) return std::nullopt;
  const GroundView view_a{Grey(a.left), LevelOn(plane_a)}, view_b{Grey(b.left), LevelOn(plane_b)};
  const Pose T_left_ref = Pose::Trans(camera.left.offset);
  const Pose T_ref_ground_a = T_left_ref.inverse() * view_a.T_cam_ground;
  const Pose T_ref_ground_b = T_left_ref.inverse() * view_b.T_cam_ground;
  const std::optional<Pose> motion =
      FindMotion(view_a, view_b, camera, OnGround(T_ref_ground_a.inverse() * T_a_b_guess * T_ref_ground_b), options);
  if (!motion) return std::nullopt;
  const std::optional<CommonGround> common = FindCommonGround(view_a, view_b, camera, *motion, options);
  if (!common) return std::nullopt;
  StereoFrame frame_a = SeenByBoth(a, camera, plane_a, common->in_a);
  StereoFrame frame_b = SeenByBoth(b, camera, plane_b, common->in_b);
  frame_b.T_odom_left = view_a.T_cam_ground * common->motion * view_b.T_cam_ground.inverse();
  OdometryPoints points;
  for (const StereoSighting& s : frame_b.sightings)
    points[s.point] = frame_b.T_odom_left * Triangulate(camera, s.pixel);
  for (const StereoSighting& s : frame_a.sightings) points[s.point] = Triangulate(camera, s.pixel);
  RefineWindow(camera, 1, {&frame_a, &frame_b}, points);

  // Patches overlap, and errors of neighbours are alike.
  constexpr double kAlike = 10;
  const Pose::Matrix6 covariance =
      kAlike * StepCovariance(camera, frame_a, frame_b, points, PixelNoise(camera, frame_b, points));
  const double sigma_m = std::sqrt(covariance.topLeftCorner<3, 3>().trace());
  if (!(sigma_m <= options.max_sigma_m)) return std::nullopt;
  // Exp(d) in the left camera's axes is Exp(Adj(T_ref_left) d) in the reference camera's.
  const Pose::Matrix6 adjoint = T_left_ref.inverse().Adj();
  return RelativePose{T_left_ref.inverse() * frame_b.T_odom_left * T_left_ref,
                      adjoint * covariance * adjoint.transpose()};
}

}  // namespace sslcd
