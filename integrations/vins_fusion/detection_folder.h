// SPDX-License-Identifier: BSD-3-Clause
// Detections from a recorded sequence folder, by stamp. Knows neither ROS nor VINS.
#pragma once

#include <string>
#include <vector>

#include "sslcd/core/detection.h"
#include "sslcd/core/label.h"

namespace sslcd::vins {

/// A sequence folder of sslcd (docs/formats.md): times.txt with VINS's stamps, detections.txt or
/// detections/%06d.txt, and where there are any embeddings.npy, colours.npy, sequence.yaml. Its
/// odometry is not read.
class DetectionFolder {
 public:
  /// A keyframe and a frame of the folder are the same if their stamps differ by no more. [s]
  static constexpr double kTolerance = 5e-3;

  /// Throws Error(kBadInput).
  explicit DetectionFolder(const std::string& path);

  /// Detections of the frame with that stamp [s]; none: no such frame.
  std::vector<Detection> At(double stamp) const;
  const LabelTable& labels() const { return labels_; }
  double first_stamp() const { return frames_.front().stamp; }
  double last_stamp() const { return frames_.back().stamp; }
  bool Has(double stamp) const { return Find(stamp) != nullptr; }

 private:
  const Frame* Find(double stamp) const;

  std::vector<Frame> frames_;  // by stamp, at least one
  LabelTable labels_;
};

}  // namespace sslcd::vins
