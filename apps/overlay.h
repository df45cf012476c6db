// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <utility>

#include "sslcd/core/camera.h"
#include "sslcd/core/detection.h"
#include "sslcd/core/image.h"

namespace sslcd::apps {

/// Left images with the frame's number, boxes with label, score and distance, and cuboids whose
/// front has a cross, one file per frame: FOLDER/000007.jpg. Creates
/// the folder with the first image and leaves all other files alone.
class Overlays {
 public:
  explicit Overlays(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Draws the boxes and cuboids of a frame over its left image. Throws Error(kOutput).
  void Write(const Frame& frame, const ImageView& left, const Camera& camera);

  /// Removes the images of an earlier run whose frames were not drawn in this run. Throws
  /// Error(kOutput).
  void RemoveOthers() const;

 private:
  std::filesystem::path folder_;
  std::set<std::string> written_;  // names
};

}  // namespace sslcd::apps
