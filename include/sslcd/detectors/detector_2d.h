// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sslcd/core/camera.h"
#include "sslcd/core/export.h"
#include "sslcd/core/image.h"
#include "sslcd/core/timing.h"
#include "sslcd/inference/options.h"

namespace SSLCD_EXPORT sslcd {

/// A model that finds boxes in one image.
class Detector2d {
 public:
  /// Reads `model_yaml` (detectors/model_description.h) and loads its model. Throws Error if the
  /// description is wrong, if the model cannot be loaded, or if its inputs and outputs differ in
  /// shape from the description; the message has both shapes.
  static Detector2d Load(const std::string& model_yaml, const InferenceOptions& options = {});
  Detector2d(Detector2d&&) noexcept;
  Detector2d& operator=(Detector2d&&) noexcept;
  ~Detector2d();

  /// Detects the objects in an image, best score first. Boxes are in pixels of the image and
  /// clipped to it. Adds the times "NAME prepare", "NAME run" and "NAME decode" to `timing`. Throws
  /// Error if the image is not B G R or the model returns NaN.
  std::vector<ImageDetection> Detect(const ImageView& image, TimingTable* timing = nullptr) const;

  const std::string& name() const;

  /// ModelOutput::box_sigma of the description.
  double box_sigma() const;

 private:
  struct Impl;
  explicit Detector2d(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace sslcd
