// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sslcd/baselines/lin.h"
#include "sslcd/baselines/point_matches.h"
#include "sslcd/baselines/semantic_histogram.h"
#include "sslcd/baselines/x_view.h"

namespace sslcd::baselines {

/// All that config/baselines.yaml holds.
struct BaselineOptions {
  LinOptions lin;
  XViewOptions x_view;
  SemanticHistogramOptions semantic_histogram;
  PointMatchOptions point_matches;
};
void DescribeFields(FieldVisitor& visitor, BaselineOptions& options);

}  // namespace sslcd::baselines
