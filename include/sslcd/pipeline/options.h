// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sslcd/association/options.h"
#include "sslcd/bundle/options.h"
#include "sslcd/closing/options.h"
#include "sslcd/core/detection_noise.h"
#include "sslcd/core/export.h"
#include "sslcd/core/fields.h"
#include "sslcd/map/options.h"
#include "sslcd/perception/colour.h"
#include "sslcd/perception/filter.h"
#include "sslcd/refine/options.h"

namespace SSLCD_EXPORT sslcd {

/// The sliding-window adjustment at every keyframe.
struct WindowOptions {
  bool enabled = true;
  int keyframes = 8;           ///< cameras in the window
  double keyframe_m = 0.5;     ///< path from one keyframe to the next
  double keyframe_rad = 0.05;  ///< rotation of the camera that makes a new keyframe
  /// objects with fewer sightings stay out ("more than 4 times", paper III-C)
  int min_sightings = 5;
};
void DescribeFields(FieldVisitor& visitor, WindowOptions& options);

/// All options of the mapper.
struct Options {
  DetectionFilterOptions filter;
  ColourOptions colour;
  DetectionNoise noise;
  AssociationOptions association;
  MapOptions map;
  LevelOptions level;
  WindowOptions window;
  BaOptions ba;
  LoopOptions loop;
  RefineOptions refine;
};
void DescribeFields(FieldVisitor& visitor, Options& options);

/// Returns all problems of the options in the order of the fields: fields outside their range
/// (including NaN) and fields that do not fit together. Empty: the options are valid.
std::vector<FieldProblem> Check(const Options& options);

/// Presets of all options: the equations as printed in the paper (kPaper), or the recommended
/// system (kRobust, the same as `Options()`). A preset only sets values of options.
enum class Mode { kRobust, kPaper };
/// The options of a preset.
Options DefaultOptions(Mode mode);

}  // namespace sslcd
