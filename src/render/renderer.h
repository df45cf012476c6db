// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "render/options.h"
#include "sim/halv.h"

namespace sslcd::render {

enum class Side { kLeft, kRight };

/// One image, row by row from the top left.
struct View {
  int width = 0, height = 0;
  std::vector<std::uint8_t> bgr;  ///< three bytes per pixel
  /// depth along the optical axis at the pixel's centre; 0: sky [m]
  std::vector<float> depth;
  std::vector<int> identity;  ///< WorldObject::id at the pixel's centre; -1: none
  std::size_t PixelAt(int x, int y) const { return static_cast<std::size_t>(y) * width + x; }
};

/// Renders the images of a world's stereo camera: the pinhole camera of calib.txt (pixel centres at
/// whole numbers), and a second one `baseline_m` to the right. Ray casting with Embree: Wald et
/// al., "Embree: a kernel framework for efficient CPU ray tracing", 2014.
/// Details that the world does not define (shape of cars, ground, buildings) depend on its objects
/// and the seed. Objects stay within their cuboids.
class Renderer {
 public:
  /// Copies the required parts of the world. Throws Error(kUsage) if options are out of range, the
  /// build has no Embree, the camera has no size or the world has no frames.
  Renderer(const sim::HalvWorld& scene, std::uint64_t seed, const RenderOptions& options = {});
  ~Renderer();

  int frames() const;
  int objects() const;  ///< number of objects in the world; identities are smaller

  /// Renders an image. May be called from several threads; the result depends only on the
  /// arguments. Takes about 0.5 s for 1280x720. Throws Error(kUsage) if the frame does not exist.
  View Render(int frame, Side side) const;

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace sslcd::render
