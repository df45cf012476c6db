// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/patch_alignment.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

namespace sslcd {
namespace {

/// Interpolates between four pixels, which must all be inside.
double Sample(const cv::Mat& image, double x, double y) {
  const int column = static_cast<int>(x), row = static_cast<int>(y);
  const double fx = x - column, fy = y - row;
  const unsigned char *above = image.ptr(row) + column, *below = image.ptr(row + 1) + column;
  return (1 - fy) * ((1 - fx) * above[0] + fx * above[1]) +
         fy * ((1 - fx) * below[0] + fx * below[1]);
}

bool IsInside(const cv::Mat& image, double x, double y, double margin) {
  return x >= margin && y >= margin && x < image.cols - 1 - margin && y < image.rows - 1 - margin;
}

struct PatchPixel {
  Eigen::Vector2d offset;  // predicted offset from the patch's middle in the other image
  double value = 0;
  Vec3 by;  // derivatives by a shift to the right, a shift down and brightness
};

/// Whether `count` pixels determine the shift in both directions with unknown brightness. `H`: sum
/// of by by^T.
bool HasTexture(const Eigen::Matrix3d& H, int count) {
  // [grey values^2 per pixel] lower bound of the smaller eigenvalue; less is noise. Set by hand.
  constexpr double kLeast = 0.1;
  const Eigen::Matrix2d shift =
      H.topLeftCorner<2, 2>() - H.topRightCorner<2, 1>() * H.bottomLeftCorner<1, 2>() / count;
  const double half = 0.5 * shift.trace();
  return half - std::sqrt(std::max(0., half * half - shift.determinant())) > kLeast * count;
}

}  // namespace

std::optional<Eigen::Matrix3d> PlaneHomography(const Camera& camera, const Pose& T_to_from,
                                               const Vec3& point, const Vec3& normal) {
  constexpr double kNearest = 0.1;  // [m] in front of both cameras; set by hand
  constexpr double kEdgeOn = 0.02;  // [rad] between ray and plane; set by hand
  const double away = normal.dot(point);
  if (!(point.z() > kNearest && (T_to_from * point).z() > kNearest)) return std::nullopt;
  if (!(std::abs(away) > kEdgeOn * normal.norm() * point.norm())) return std::nullopt;
  Eigen::Matrix3d K;
  K << camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1;
  const Eigen::Matrix3d motion =
      T_to_from.so3().matrix() + T_to_from.translation() * normal.transpose() / away;
  return Eigen::Matrix3d(K * motion * K.inverse());
}

std::optional<AlignedPatch> AlignPatch(const Patch& patch, const Eigen::Matrix3d& homography,
                                       const cv::Mat& to, const cv::Point2f& guess) {
  // All set by hand.
  constexpr int kMaxSteps = 30;
  constexpr int kMaxStretch = 8;                 // of the patch's half width
  constexpr double kDone = 0.003, kReach = 1.5;  // [px] last step; distance from the guess
  constexpr double kMinArea = 0.1;               // of a pixel in the other image
  const int half = patch.half, count = (2 * half + 1) * (2 * half + 1);
  if (!IsInside(patch.grey, patch.at.x, patch.at.y, half + 1)) return std::nullopt;
  const auto map = [&](double u, double v) -> Eigen::Vector2d {
    return Vec3(homography * Vec3(patch.at.x + u, patch.at.y + v, 1)).hnormalized();
  };
  const Eigen::Vector2d middle = map(0, 0);
  Eigen::Matrix2d stretch;  // stretch of the patch about its middle
  stretch << 0.5 * (map(1, 0) - map(-1, 0)), 0.5 * (map(0, 1) - map(0, -1));
  if (!(stretch.determinant() > kMinArea)) return std::nullopt;  // seen edge on, or from behind
  double extent = 0;
  thread_local std::vector<PatchPixel> pixels;
  pixels.clear();
  Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
  for (int v = -half; v <= half; ++v) {
    for (int u = -half; u <= half; ++u) {
      const auto value = [&](int x, int y) {
        return Sample(patch.grey, patch.at.x + x, patch.at.y + y);
      };
      const Vec3 by(0.5 * (value(u + 1, v) - value(u - 1, v)),
                    0.5 * (value(u, v + 1) - value(u, v - 1)), 1);
      pixels.push_back({map(u, v) - middle, value(u, v), by});
      H += by * by.transpose();
      const Eigen::Vector2d& offset = pixels.back().offset;
      if (!(offset.norm() < kMaxStretch * half)) return std::nullopt;  // seen nearly edge on
      extent = std::max(extent, offset.lpNorm<Eigen::Infinity>());
    }
  }
  if (!HasTexture(H, count)) return std::nullopt;
  const Eigen::Matrix3d inverse = H.inverse();
  Eigen::Vector2d at(guess.x, guess.y);
  double brighter = 0;
  for (int step = 0; step < kMaxSteps && IsInside(to, at.x(), at.y(), extent); ++step) {
    Vec3 gradient = Vec3::Zero();
    double squares = 0;
    for (const PatchPixel& pixel : pixels) {
      const double error =
          Sample(to, at.x() + pixel.offset.x(), at.y() + pixel.offset.y()) - pixel.value - brighter;
      gradient += pixel.by * error;
      squares += error * error;
    }
    const Vec3 change = inverse * gradient;
    const Eigen::Vector2d moved = stretch * change.head<2>();
    at -= moved;
    brighter += change.z();
    const cv::Point2f found(static_cast<float>(at.x()), static_cast<float>(at.y()));
    if (!(std::hypot(found.x - guess.x, found.y - guess.y) <= kReach)) break;
    if (moved.norm() < kDone) return AlignedPatch{found, std::sqrt(squares / count)};
  }
  return std::nullopt;
}

std::optional<cv::Point2f> FindPatch(const Patch& patch, const Camera& camera,
                                     const Pose& T_to_from, const cv::Mat& to,
                                     const cv::Point2f& guess) {
  const Vec3 facing = Vec3::UnitZ(), level = Vec3::UnitY();
  std::optional<AlignedPatch> best;
  for (const Vec3& normal : {facing, level}) {
    const std::optional<Eigen::Matrix3d> homography =
        PlaneHomography(camera, T_to_from, patch.point, normal);
    if (!homography) continue;
    const std::optional<AlignedPatch> found = AlignPatch(patch, *homography, to, guess);
    if (found && (!best || found->difference < best->difference)) best = found;
  }
  if (!best) return std::nullopt;
  return best->at;
}

}  // namespace sslcd
