// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "sslcd/core/fields.h"
#include "sslcd/ground/ground_alignment.h"
#include "sslcd/inference/options.h"
#include "sslcd/lifting/lift.h"
#include "sslcd/visual_odometry/odometry.h"

namespace sslcd {

/// How frames are made from images.
struct VisionOptions {
  /// description of a 2D or 3D detector (docs/models.md); empty: boxes come from a file
  std::string detector;
  std::string embedder;  ///< description of a re-identification model; empty: no embeddings
  InferenceOptions inference;
  /// file of the classes that are lifted (LoadClasses), instead of those in `lift`; empty: those
  std::string classes;
  LiftOptions lift;  ///< of 2D boxes to cuboids
  StereoOdometryOptions odometry;
  /// of images of different passes; the ground is that of `lift`
  GroundAlignmentOptions alignment;
};
void DescribeFields(FieldVisitor& visitor, VisionOptions& options);

/// What is wrong with these options, as Check(const Options&) says it; keys begin with `vision.`.
std::vector<FieldProblem> Check(const VisionOptions& options);

}  // namespace sslcd
