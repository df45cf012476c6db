// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace sslcd::render {

using Vec2f = Eigen::Vector2f;
using Vec3f = Eigen::Vector3f;  // points, or linear red, green, blue

inline float Mix(float a, float b, float t) { return a + t * (b - a); }
inline Vec3f Mix(const Vec3f& a, const Vec3f& b, float t) { return a + t * (b - a); }
/// Like std::floor, which is a function call without SSE 4.1.
inline int Floor(float x) {
  const int towards_zero = static_cast<int>(x);
  return towards_zero - (x < static_cast<float>(towards_zero));
}
inline float Fraction(float x) { return x - static_cast<float>(Floor(x)); }

inline float Clamp01(float x) { return std::min(std::max(x, 0.f), 1.f); }

/// 0 below `low`, 1 above `high`, smooth in between.
inline float Smooth(float low, float high, float x) {
  const float t = Clamp01((x - low) / (high - low));
  return t * t * (3 - 2 * t);
}

/// The share of a pixel of width `footprint` at `distance` that a band of half-width `half` around
/// 0 covers.
inline float Band(float distance, float half, float footprint) {
  const float low = std::max(distance - 0.5f * footprint, -half),
              high = std::min(distance + 0.5f * footprint, half);
  return std::max(high - low, 0.f) / footprint;
}

/// Converts display values (gamma 2) to linear light.
inline Vec3f Linear(const Vec3f& display) { return display.cwiseProduct(display); }

}  // namespace sslcd::render
