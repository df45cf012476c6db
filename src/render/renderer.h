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
  std::vector<std::uint8_t> bgr;  ///< three bytes a pixel
  /// along the optical axis, through the pixel's centre; 0: sky [m]
  std::vector<float> depth;
  std::vector<int> identity;  ///< WorldObject::id seen through the pixel's centre, -1: none
  std::size_t PixelAt(int x, int y) const { return static_cast<std::size_t>(y) * width + x; }
};

/// Makes images of a world as its stereo camera sees it: the pinhole camera of calib.txt (pixel
/// centres at whole numbers), whose right one is `baseline_m` to the right. Ray casting with
/// Embree: Wald et al., "Embree: a kernel framework for efficient CPU ray tracing", 2014.
///
/// What the world does not tell (shape of cars, ground, buildings) follows from its objects and the
/// seed. Objects stay within their cuboids.
class Renderer {
 public:
  /// Keeps what it needs of the world. Throws Error(kUsage): options out of range; built without
  /// Embree; a camera without size; nothing drives (no frames).
  Renderer(const sim::HalvWorld& scene, std::uint64_t seed, const RenderOptions& options = {});
  ~Renderer();

  int frames() const;
  int objects() const;  ///< in the world; identities are below that

  /// May be called from several threads; the result depends on the arguments alone. About 0.5 s for
  /// 1280x720. Throws Error(kUsage) where there is no such frame.
  View Render(int frame, Side side) const;

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace sslcd::render
