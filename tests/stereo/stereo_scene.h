// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "perception/projection.h"
#include "sslcd/core/camera.h"
#include "sslcd/core/image.h"
#include "sslcd/core/pose.h"
#include "sslcd/perception/opencv_image.h"

namespace sslcd {

/// A cuboid with noise on its sides; the frame is that of a Detection.
struct Block {
  Pose T_cam_object;
  Vec3 dims{0, 0, 0};
};

/// Blocks on a plane, seen by a stereo pair; one ray a pixel.
class StereoScene {
 public:
  StereoCamera camera{{450, 450, 319.5, 179.5, Vec3(0, 0, 0), 640, 360}, 0.3};
  double height_m = 1.2;
  double tilt_rad = 0;  ///< of the ground: it rises ahead
  bool texture = true;
  double fade_m = 1e9;  ///< distance at which the ground's texture has faded to a third
  std::vector<Block> blocks;
  /// where the scene is seen from; blocks and ground are in the scene's axes
  Pose T_scene_cam;
  std::uint32_t ground_seed = 1;  ///< another one: another place

  /// A block that stands on the ground: middle of its bottom x to the right, z ahead, yaw from
  /// right to ahead.
  void Add(double x, double z, double yaw, const Vec3& dims) {
    const Vec3 along(std::cos(yaw), 0, std::sin(yaw)), up(0, -1, 0);
    Eigen::Matrix3d axes;
    axes << along, up.cross(along), up;
    blocks.push_back(
        {Pose(lie::SO3<double>::FromMatrix(axes), {x, height_m - 0.5 * dims.z(), z}), dims});
  }

  /// The detection of a block by a perfect detector, hidden or not.
  Box2d BoxOf(int i) const {
    return *ProjectCuboid(blocks[i].T_cam_object, blocks[i].dims, camera.left);
  }

  void Render() {
    left = Image(camera.left, 0);
    right = Image(RightOf(camera), camera.baseline_m);
  }
  StereoView view() const { return {ViewOf(left), ViewOf(right)}; }
  cv::Mat left, right;

 private:
  /// Noise between -1 and 1, smooth over a unit.
  static double Noise(double x, double y, std::uint32_t seed) {
    const double x0 = std::floor(x), y0 = std::floor(y);
    const auto at = [&](double i, double j) {
      std::uint32_t h = seed +
                        static_cast<std::uint32_t>(static_cast<std::int64_t>(i)) * 374761393u +
                        static_cast<std::uint32_t>(static_cast<std::int64_t>(j)) * 668265263u;
      h = (h ^ (h >> 13)) * 1274126177u;
      return ((h ^ (h >> 16)) & 0xffff) / 32767.5 - 1;
    };
    const auto smooth = [](double t) { return t * t * (3 - 2 * t); };
    const double sx = smooth(x - x0), sy = smooth(y - y0);
    return (1 - sy) * ((1 - sx) * at(x0, y0) + sx * at(x0 + 1, y0)) +
           sy * ((1 - sx) * at(x0, y0 + 1) + sx * at(x0 + 1, y0 + 1));
  }
  double Brightness(double x, double y, std::uint32_t seed) const {
    return texture
               ? 128 + 45 * Noise(x / 0.12, y / 0.12, seed) + 35 * Noise(x / 0.4, y / 0.4, seed + 7)
               : 128;
  }

  double Trace(const Vec3& origin, const Vec3& ray) const {
    double nearest = 1e9, brightness = 200;  // sky
    const Vec3 up(0, -std::cos(tilt_rad), -std::sin(tilt_rad));
    const double down = up.dot(ray);
    if (down < -1e-6) {
      nearest = -(height_m + up.dot(origin)) / down;
      const Vec3 hit = origin + nearest * ray;
      brightness =
          128 + std::exp(-nearest / fade_m) * (Brightness(hit.x(), hit.z(), ground_seed) - 128);
    }
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      const Pose T_object_cam = blocks[i].T_cam_object.inverse();
      const Vec3 from = T_object_cam * origin, along = T_object_cam.rotation() * ray,
                 half = 0.5 * blocks[i].dims;
      double enter = 0, leave = nearest;
      int side = -1;
      for (int axis = 0; axis < 3; ++axis) {
        const double speed = std::abs(along[axis]) > 1e-12 ? along[axis] : 1e-12;
        const double a = (-half[axis] - from[axis]) / speed, b = (half[axis] - from[axis]) / speed;
        if (std::min(a, b) > enter) {
          enter = std::min(a, b);
          side = axis;
        }
        leave = std::min(leave, std::max(a, b));
      }
      if (side < 0 || enter >= leave) continue;
      nearest = enter;
      const Vec3 hit = from + enter * along;
      brightness = Brightness(hit[(side + 1) % 3], hit[(side + 2) % 3],
                              100 + 10 * static_cast<std::uint32_t>(i) + side);
    }
    return brightness;
  }
  cv::Mat Image(const sslcd::Camera& from, double x) const {
    cv::Mat image(from.height, from.width, CV_8U);
    const Vec3 origin = T_scene_cam * Vec3(x, 0, 0);
    for (int v = 0; v < image.rows; ++v) {
      for (int u = 0; u < image.cols; ++u) {
        const Vec3 ray((u - from.cx) / from.fx, (v - from.cy) / from.fy, 1);
        image.at<unsigned char>(v, u) =
            cv::saturate_cast<unsigned char>(Trace(origin, T_scene_cam.so3() * ray));
      }
    }
    return image;
  }
};

}  // namespace sslcd
