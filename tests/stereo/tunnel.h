// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>

#include "sslcd/core/camera.h"
#include "sslcd/perception/opencv_image.h"

namespace sslcd {

/// Images of a tunnel of square section with patterned walls, by casting a ray for each pixel:
/// exact geometry, and patterns that stay put.
class Tunnel {
 public:
  explicit Tunnel(unsigned seed = 1) : seed_(seed) {}

  static StereoCamera Camera() {
    sslcd::Camera left;
    left.fx = 200;
    left.fy = 210;
    left.cx = 160;
    left.cy = 120;
    left.width = 320;
    left.height = 240;
    return {left, 0.3};
  }

  /// `gain` and `noise` (a standard deviation) are of grey levels.
  struct Pair {
    cv::Mat left, right;
    StereoView view() const { return {ViewOf(left), ViewOf(right)}; }
  };
  Pair Look(const Pose& T_world_left, double gain = 1, double noise = 1) const {
    const StereoCamera camera = Camera();
    const Pose T_world_right = T_world_left * Pose::Trans(camera.baseline_m, 0, 0);
    return {Image(camera.left, T_world_left, gain, noise, 1),
            Image(camera.left, T_world_right, gain, noise, 2)};
  }

 private:
  // half width, half height, length of a section [m]
  static constexpr double kWide = 3, kUp = 2, kLong = 30;

  static double Hash(std::int64_t a, std::int64_t b, std::int64_t c) {
    std::uint64_t h = static_cast<std::uint64_t>(a) * 0x9E3779B97F4A7C15U ^
                      static_cast<std::uint64_t>(b) * 0xC2B2AE3D27D4EB4FU ^
                      static_cast<std::uint64_t>(c) * 0x165667B19E3779F9U;
    h ^= h >> 29;
    h *= 0xBF58476D1CE4E5B9U;
    h ^= h >> 32;
    h *= 0x94D049BB133111EBU;
    h ^= h >> 29;
    return static_cast<double>(h >> 11) * 0x1p-53;
  }

  /// Smooth noise in [0, 1], one value a metre.
  double Noise(double u, double v, int layer) const {
    const double iu = std::floor(u), iv = std::floor(v);
    const auto at = [&](int du, int dv) {
      return Hash(static_cast<std::int64_t>(iu) + du, static_cast<std::int64_t>(iv) + dv,
                  layer + 64 * seed_);
    };
    const auto smooth = [](double t) { return t * t * (3 - 2 * t); };
    const double a = smooth(u - iu), b = smooth(v - iv);
    return (1 - b) * ((1 - a) * at(0, 0) + a * at(1, 0)) + b * ((1 - a) * at(0, 1) + a * at(1, 1));
  }

  double Brightness(const Vec3& from, const Vec3& ray, double pixel) const {
    double best = 1e9;
    int wall = 0;
    const auto meet = [&](double t, int which) {
      if (t > 1e-6 && t < best) {
        best = t;
        wall = which;
      }
    };
    meet((kWide - from.x()) / ray.x(), 0);
    meet((-kWide - from.x()) / ray.x(), 1);
    meet((kUp - from.y()) / ray.y(), 2);
    meet((-kUp - from.y()) / ray.y(), 3);
    meet((kLong - from.z()) / ray.z(), 4);
    meet((-kLong - from.z()) / ray.z(), 5);
    const Vec3 p = from + best * ray;
    const double u = wall < 4 ? p.z() : p.x(), v = wall < 2 ? p.y() : wall < 4 ? p.x() : p.y();
    double sum = 0, weight = 0;
    int layer = wall;
    for (const double cell : {1.2, 0.5, 0.2, 0.08}) {
      if (cell > 3 * pixel * best) {
        sum += cell * Noise(u / cell, v / cell, layer);
        weight += cell;
      }
      layer += 8;
    }
    return weight > 0 ? sum / weight : 0.5;
  }

  cv::Mat Image(const sslcd::Camera& camera, const Pose& T_world_cam, double gain, double noise,
                int salt) const {
    cv::Mat image(camera.height, camera.width, CV_8UC1);
    const Eigen::Matrix3d R = T_world_cam.so3().matrix();
    const Vec3 from = T_world_cam.translation();
    const auto moment = static_cast<std::int64_t>(1e6 * (from.sum() + R.sum()));
    for (int row = 0; row < camera.height; ++row) {
      for (int column = 0; column < camera.width; ++column) {
        const Vec3 ray =
            R * Vec3((column - camera.cx) / camera.fx, (row - camera.cy) / camera.fy, 1);
        const double grain = Hash(row * 4096 + column, moment, salt) +
                             Hash(row * 4096 + column, moment, salt + 2) - 1;
        const double grey =
            gain * 255 * Brightness(from, ray, 1 / camera.fx) + noise * grain * std::sqrt(6);
        image.at<unsigned char>(row, column) = cv::saturate_cast<unsigned char>(grey);
      }
    }
    return image;
  }

  unsigned seed_;
};

}  // namespace sslcd
