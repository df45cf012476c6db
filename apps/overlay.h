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

/// Left images with what was found in them, one file a frame: FOLDER/000007.jpg, made with the
/// first. Whatever else lies there is left alone.
class Overlays {
 public:
  explicit Overlays(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Draws the boxes and cuboids of a frame over its left image. Throws Error(kOutput).
  void Write(const Frame& frame, const ImageView& left, const Camera& camera);

  /// Removes those of an earlier run, of frames that were not drawn this time. Throws
  /// Error(kOutput).
  void RemoveOthers() const;

 private:
  std::filesystem::path folder_;
  std::set<std::string> written_;  // names
};

}  // namespace sslcd::apps
