// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "sslcd/core/export.h"
#include "sslcd/core/fields.h"
#include "sslcd/ground/ground_alignment.h"
#include "sslcd/inference/options.h"
#include "sslcd/lifting/lift.h"
#include "sslcd/visual_odometry/odometry.h"

namespace SSLCD_EXPORT sslcd {

/// Options of making frames from images.
struct VisionOptions {
  /// description of a 2D or 3D detector (docs/models.md); empty: boxes come from a file
  std::string detector;
  std::string embedder;  ///< description of a re-identification model; empty: no embeddings
  InferenceOptions inference;
  /// file of the classes to lift (LoadClasses); empty: those of `lift`
  std::string classes;
  LiftOptions lift;  ///< lifting of 2D boxes to cuboids
  StereoOdometryOptions odometry;
  /// alignment of images of different passes, with the ground of `lift`
  GroundAlignmentOptions alignment;
};
void DescribeFields(FieldVisitor& visitor, VisionOptions& options);

/// Returns the problems of these options, like Check(const Options&). Keys start with `vision.`.
std::vector<FieldProblem> Check(const VisionOptions& options);

}  // namespace sslcd
