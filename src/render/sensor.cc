// SPDX-License-Identifier: BSD-3-Clause
#include "render/sensor.h"

#include "render/noise.h"

namespace sslcd::render {
namespace {

/// Approximately normal with mean 0 and deviation 1: the sum of the four bytes of the hash.
float NormalOf(std::uint32_t hash) {
  const auto sum =
      static_cast<float>((hash & 255) + (hash >> 8 & 255) + (hash >> 16 & 255) + (hash >> 24));
  return (sum - 510) / 147.8f;
}

}  // namespace

std::vector<std::uint8_t> Develop(const std::vector<Sample>& samples, int width, int height,
                                  float exposure, const RenderOptions& options,
                                  std::uint32_t seed) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(3 * samples.size());
  const float vignetting = static_cast<float>(options.vignetting),
              noise = static_cast<float>(options.noise);
  const float half_width = 0.5f * static_cast<float>(width),
              half_height = 0.5f * static_cast<float>(height);
  std::uint32_t pixel = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x, ++pixel) {
      const float u = static_cast<float>(x) / half_width - 1,
                  v = static_cast<float>(y) / half_height - 1;
      const float gain = exposure * (1 - vignetting * 0.5f * (u * u + v * v));
      for (int channel : {2, 1, 0}) {
        const float density = 1 - std::exp(-gain * samples[pixel].colour[channel]);
        const float level =
            255 * std::sqrt(density) + noise * NormalOf(Hash(3 * pixel + channel, seed));
        bytes.push_back(static_cast<std::uint8_t>(std::clamp(level + 0.5f, 0.f, 255.f)));
      }
    }
  }
  return bytes;
}

}  // namespace sslcd::render
