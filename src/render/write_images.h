// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>

#include "render/renderer.h"

namespace sslcd::render {

/// Units per metre of depth images, as in KITTI.
constexpr double kDepthUnitsPerMetre = 256;

struct ImageOutput {
  bool truth = false;  ///< also write depth and instance images
  int threads = 1;
  /// called after each frame, never twice at the same time
  std::function<void(int done, int frames)> progress;
};

/// Writes the images of all frames into a sequence folder: image_2/%06d.png (left), image_3/
/// (right), and with `truth` depth_2, depth_3 (16 bit, kDepthUnitsPerMetre; 0: sky, or 256 m and
/// farther), instance_2, instance_3 (16 bit, WorldObject::id + 1, the numbers of landmark_ids.txt +
/// 1; 0: none). The bytes do not depend on the number of threads. Throws Error(kUsage) for threads
/// < 1 or too many objects for 16 bits, and Error(kOutput).
void WriteImages(const Renderer& renderer, const std::filesystem::path& folder,
                 const ImageOutput& output = {});

}  // namespace sslcd::render
