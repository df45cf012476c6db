// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sslcd/core/camera.h"
#include "sslcd/core/image.h"
#include "sslcd/core/timing.h"
#include "sslcd/inference/options.h"

namespace sslcd {

/// A re-identification model: what an object looks like, as a vector (paper III-A.2).
class Embedder {
 public:
  /// See Detector2d::Load.
  static Embedder Load(const std::string& model_yaml, const InferenceOptions& options = {});
  Embedder(Embedder&&) noexcept;
  Embedder& operator=(Embedder&&) noexcept;
  ~Embedder();

  /// One vector of unit length for each box; empty for a box that holds no pixel of the image. All
  /// boxes go through the model at once where it takes any number. Times as Detector2d's. Throws
  /// Error when the image is not B G R or the model returns NaN.
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
