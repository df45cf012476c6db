// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "sslcd/core/label.h"
#include "sslcd/core/pose.h"

namespace sslcd {

/// The content of sequence.yaml.
struct SequenceInfo {
  std::optional<Vec3> up_axis;            ///< unit vector in the world (odometry) frame
  int image_width = 0, image_height = 0;  ///< [px]; 0: not given
  LabelTable labels;
};

/// Reads sequence.yaml:
///
///   up_axis: [0, -1, 0]
///   image_size_px: [1242, 375]
///   labels: {Car: {symmetry: none}, Tree: {symmetry: full}}
///
/// All keys are optional. Throws Error with file:line:column for unknown or duplicate keys and for
/// wrong values.
SequenceInfo ReadSequenceYaml(const std::string& path);

/// Returns the text of sequence.yaml. Labels are quoted if YAML could read them as another value.
std::string SequenceYamlText(const SequenceInfo& info);

}  // namespace sslcd
