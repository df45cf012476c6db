// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace sslcd::render {

using Vec2f = Eigen::Vector2f;
using Vec3f = Eigen::Vector3f;  // points; and linear red, green, blue

inline float Mix(float a, float b, float t) { return a + t * (b - a); }
inline Vec3f Mix(const Vec3f& a, const Vec3f& b, float t) { return a + t * (b - a); }
/// As std::floor, which without SSE 4.1 is a call.
inline int Floor(float x) {
  const int towards_zero = static_cast<int>(x);
  return towards_zero - (x < static_cast<float>(towards_zero));
}
inline float Fraction(float x) { return x - static_cast<float>(Floor(x)); }

inline float Clamp01(float x) { return std::min(std::max(x, 0.f), 1.f); }

/// 0 below `low`, 1 above `high`, smooth between.
inline float Smooth(float low, float high, float x) {
  const float t = Clamp01((x - low) / (high - low));
  return t * t * (3 - 2 * t);
}

/// How much a band of half-width `half` about 0 covers of a pixel of width `footprint` at distance
/// `distance`.
inline float Band(float distance, float half, float footprint) {
  const float low = std::max(distance - 0.5f * footprint, -half),
              high = std::min(distance + 0.5f * footprint, half);
  return std::max(high - low, 0.f) / footprint;
}

/// From values of a display (gamma 2) to light.
inline Vec3f Linear(const Vec3f& display) { return display.cwiseProduct(display); }

}  // namespace sslcd::render
