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

/// A re-identification model, which maps the appearance of an object to a vector (paper III-A.2).
class Embedder {
 public:
  /// See Detector2d::Load.
  static Embedder Load(const std::string& model_yaml, const InferenceOptions& options = {});
  Embedder(Embedder&&) noexcept;
  Embedder& operator=(Embedder&&) noexcept;
  ~Embedder();

  /// Returns one vector of unit length per box; an empty one for a box outside of the image. Runs
  /// the model once for all boxes if it accepts any batch size. Times are those of
  /// Detector2d::Detect. Throws Error if the image is not B G R or the model returns NaN.
  std::vector<std::vector<float>> Embed(const ImageView& image, const std::vector<Box2d>& boxes,
                                        TimingTable* timing = nullptr) const;

  const std::string& name() const;
  int dimension() const;  ///< length of the vectors

 private:
  struct Impl;
  explicit Embedder(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace sslcd
