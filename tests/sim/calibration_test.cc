// SPDX-License-Identifier: BSD-3-Clause
#include "sim/calibration.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "sslcd/core/error.h"

namespace sslcd::sim {
namespace {

TEST(Calibration, EveryTargetIsReached) {
  const std::vector<CalibrationRow> rows = Calibrate(3);
  EXPECT_EQ(rows.size(), 12u);
  for (const CalibrationRow& row : rows)
    EXPECT_NEAR(row.reached, row.target, 0.1 * row.target) << row.what;
}

TEST(Calibration, FollowsTheOptions) {
  HalvOptions options;
  options.detector.scale = 0;
  options.detector.flip_rate = 0;
  options.appearance.other_object = 0.1;
  const std::vector<CalibrationRow> rows = Calibrate(1, options);
  const auto reached = [&](const std::string& part) {
    const auto row = std::find_if(rows.begin(), rows.end(), [&](const CalibrationRow& r) {
      return r.what.find(part) != std::string::npos;
    });
    return row == rows.end() ? -1 : row->reached;
  };
  EXPECT_NEAR(reached("3D IoU"), 1, 1e-3);
  EXPECT_NEAR(reached("different cars"), 0.1, 0.03);
  EXPECT_NE(ToMarkdown(rows).find("| 0.450 | 1.000 | no |"), std::string::npos) << ToMarkdown(rows);
}

TEST(Calibration, NeedsSeeds) { EXPECT_THROW(Calibrate(0), Error); }

TEST(MeasureEmbeddings, NothingToMeasure) {
  EXPECT_EQ(MeasureEmbeddings({}, 100).same_side.pairs, 0);
  EXPECT_EQ(MeasureEmbeddings({HalvSequence()}, 100).other_object.pairs, 0);
}

}  // namespace
}  // namespace sslcd::sim
