// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "baselines/appearance.h"
#include "baselines/lin.h"
#include "baselines/point_matches.h"
#include "baselines/semantic_histogram.h"
#include "baselines/x_view.h"

namespace sslcd::baselines {

/// All options of config/baselines.yaml.
struct BaselineOptions {
  LinOptions lin;
  XViewOptions x_view;
  SemanticHistogramOptions semantic_histogram;
  PointMatchOptions point_matches;
  AppearanceOptions appearance;
};
void DescribeFields(FieldVisitor& visitor, BaselineOptions& options);

}  // namespace sslcd::baselines
