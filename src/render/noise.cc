// SPDX-License-Identifier: BSD-3-Clause
#include "render/noise.h"

namespace sslcd::render {

float ValueNoise(float x, float y, std::uint32_t seed) {
  const int ix = Floor(x), iy = Floor(y);
  const auto blend = [](float t) { return t * t * (3 - 2 * t); };
  const float u = blend(x - static_cast<float>(ix)), v = blend(y - static_cast<float>(iy));
  const auto at = [&](int dx, int dy) { return Unit(Hash(ix + dx, iy + dy, seed)); };
  return Mix(Mix(at(0, 0), at(1, 0), u), Mix(at(0, 1), at(1, 1), u), v);
}

float Fractal(float x, float y, std::uint32_t seed, const Octaves& octaves, float footprint) {
  float sum = 0, amplitude = 1, frequency = octaves.frequency;
  for (int octave = 0; octave < octaves.count; ++octave) {
    // an octave needs two pixels per period
    const float left = Clamp01(1.5f - 2 * frequency * footprint);
    if (left <= 0) break;
    sum += left * amplitude * (2 * ValueNoise(x * frequency, y * frequency, seed + octave) - 1);
    frequency *= 2;
    amplitude *= octaves.fall;
  }
  return sum;
}

Cell CellNoise(float x, float y, std::uint32_t seed) {
  const int ix = Floor(x), iy = Floor(y);
  float nearest = 9, second = 9;
  Cell cell;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const std::uint32_t hash = Hash(ix + dx, iy + dy, seed);
      const float px = static_cast<float>(ix + dx) + Unit(hash),
                  py = static_cast<float>(iy + dy) + Unit(Hash(hash));
      const float distance = std::sqrt((px - x) * (px - x) + (py - y) * (py - y));
      if (distance < nearest) {
        second = nearest;
        nearest = distance;
        cell.value = Unit(Hash(hash, 7));
      } else {
        second = std::min(second, distance);
      }
    }
  }
  cell.border = second - nearest;
  return cell;
}

}  // namespace sslcd::render
