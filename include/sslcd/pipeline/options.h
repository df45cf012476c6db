// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sslcd/association/options.h"
#include "sslcd/bundle/options.h"
#include "sslcd/closing/options.h"
#include "sslcd/core/detection_noise.h"
#include "sslcd/core/fields.h"
#include "sslcd/map/options.h"
#include "sslcd/perception/colour.h"
#include "sslcd/perception/filter.h"
#include "sslcd/refine/options.h"

namespace sslcd {

/// The sliding window that runs with every keyframe.
struct WindowOptions {
  bool enabled = true;
  int keyframes = 8;           ///< cameras in the window
  double keyframe_m = 0.5;     ///< a new keyframe whenever the path has grown by this
  double keyframe_rad = 0.05;  ///< a new keyframe whenever the camera has turned by this
  /// objects with fewer sightings stay out ("more than 4 times", paper III-C)
  int min_sightings = 5;
};
void DescribeFields(FieldVisitor& visitor, WindowOptions& options);

/// Everything that can be configured.
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

/// What is wrong with these options: each field outside its own range (NaN is), and fields that do
/// not fit together. Empty: nothing. All problems at once, in the order of the fields.
std::vector<FieldProblem> Check(const Options& options);

/// Presets of all options: the equations as printed (paper), or the system as its users need it
/// (robust; the same as `Options()`). A preset is nothing but values of options.
enum class Mode { kRobust, kPaper };
Options DefaultOptions(Mode mode);

}  // namespace sslcd
