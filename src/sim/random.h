// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <random>

namespace sslcd::sim {

/// Random numbers that are the same with every standard library. The C++ standard defines the
/// output of the engine, but not that of std::normal_distribution and similar classes.
class Random {
 public:
  /// Different streams of one seed are independent.
  explicit Random(std::uint64_t seed, std::uint64_t stream = 0)
      : engine_(seed + 0x9E3779B97F4A7C15u * stream) {}

  double Uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }  ///< in [0, 1)
  double Uniform(double low, double high) { return low + (high - low) * Uniform(); }
  double Normal();  ///< mean 0, standard deviation 1
  double Normal(double mean, double sigma) { return mean + sigma * Normal(); }
  bool Chance(double probability) { return Uniform() < probability; }
  int Poisson(double mean);  ///< the cost grows with the mean; 0 for mean <= 0

 private:
  std::mt19937_64 engine_;
};

}  // namespace sslcd::sim
