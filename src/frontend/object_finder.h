// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "sslcd/detectors/detector_2d.h"
#include "sslcd/detectors/detector_3d.h"
#include "sslcd/detectors/embedder.h"
#include "sslcd/frontend/image_frontend.h"

namespace sslcd {

/// Makes the detections of a stereo pair: cuboids of a 3D detector or lifted from 2D boxes, each
/// with colour and embedding.
class ObjectFinder {
 public:
  /// `boxes` replace VisionOptions::detector. Throws Error if both are missing, and the errors of
  /// loading the models.
  ObjectFinder(const StereoCamera& camera, const VisionOptions& options,
               const ColourOptions& colour, std::optional<BoxesByFrame> boxes);

  /// Adds counts and times to `report`.
  std::vector<Detection> Find(int frame, const StereoView& images, FrontendReport& report) const;

  /// True if cuboids are lifted from boxes, which does not distinguish front and back.
  bool lifts() const { return !detector_3d_; }

 private:
  std::vector<Detection> Lift(int frame, const StereoView& images, FrontendReport& report) const;

  StereoCamera camera_;
  LiftOptions lift_;
  ColourOptions colour_;
  std::optional<BoxesByFrame> boxes_;
  std::optional<Detector2d> detector_2d_;
  std::optional<Detector3d> detector_3d_;
  std::optional<Embedder> embedder_;
};

}  // namespace sslcd
