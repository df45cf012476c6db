// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "render/vectors.h"

namespace sslcd::render {

/// A 32-bit hash (the finaliser of MurmurHash3, public domain).
inline std::uint32_t Hash(std::uint32_t x) {
  x = (x ^ (x >> 16)) * 0x85EBCA6Bu;
  x = (x ^ (x >> 13)) * 0xC2B2AE35u;
  return x ^ (x >> 16);
}
inline std::uint32_t Hash(std::uint32_t x, std::uint32_t y) {
  return Hash(x + 0x9E3779B9u * Hash(y));
}
inline std::uint32_t Hash(int x, int y, std::uint32_t seed) {
  return Hash(static_cast<std::uint32_t>(x) * 0x8DA6B343u ^
              static_cast<std::uint32_t>(y) * 0xD8163841u ^ seed);
}

/// In [0, 1).
inline float Unit(std::uint32_t hash) { return static_cast<float>(hash >> 8) * 0x1p-24f; }

/// A sequence of random numbers of one seed. Draw several in one expression only within braces,
/// which are evaluated from left to right.
class Draws {
 public:
  explicit Draws(std::uint32_t seed) : seed_(seed) {}
  float operator()(float low, float high) { return Mix(low, high, Unit(Hash(seed_, ++count_))); }

 private:
  std::uint32_t seed_, count_ = 0;
};

/// Value noise: interpolated random numbers of a lattice, in [0, 1), with features about 1 wide.
float ValueNoise(float x, float y, std::uint32_t seed);

/// Octaves of value noise, each twice as fine as the one before.
struct Octaves {
  float frequency = 1;  ///< frequency of the first octave [1/m]
  int count = 1;
  float fall = 0.5f;  ///< ratio of the amplitudes of successive octaves
};

/// Sum of octaves, about -1 to 1. Details finer than `footprint` [m] fade out, so that far surfaces
/// do not flicker.
float Fractal(float x, float y, std::uint32_t seed, const Octaves& octaves, float footprint);

/// Worley noise: the distance to the borders of the cells of random points, about 0 to 1, and a
/// random number of the cell.
struct Cell {
  float border = 0, value = 0;
};
Cell CellNoise(float x, float y, std::uint32_t seed);

}  // namespace sslcd::render
