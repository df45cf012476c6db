// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sslcd/core/camera.h"
#include "sslcd/core/detection.h"
#include "sslcd/core/export.h"
#include "sslcd/core/image.h"
#include "sslcd/core/timing.h"
#include "sslcd/inference/options.h"

namespace SSLCD_EXPORT sslcd {

/// A model that finds cuboids in a stereo pair, or in its left image alone.
class Detector3d {
 public:
  /// See Detector2d::Load.
  static Detector3d Load(const std::string& model_yaml, const InferenceOptions& options = {});
  Detector3d(Detector3d&&) noexcept;
  Detector3d& operator=(Detector3d&&) noexcept;
  ~Detector3d();

  /// Detects the objects in a stereo pair, best score first: pose in the reference camera's frame
  /// (see Camera::offset), size, box in the left image, score and label. `row` is -1. Times are
  /// those of Detector2d::Detect. Throws Error if an image is not B G R or the model returns NaN.
  std::vector<Detection> Detect(const StereoView& images, const StereoCamera& camera,
                                TimingTable* timing = nullptr) const;

  const std::string& name() const;
  bool uses_right_image() const;  ///< false: `images.right` may be empty

 private:
  struct Impl;
  explicit Detector3d(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace sslcd
