// SPDX-License-Identifier: BSD-3-Clause
// Holds runs on real data to docs/figures.json, which scripts/measure.sh writes. The rules, for
// every regression test on real data:
// - An error [m] and a count lie within 15 % of the figure. A run that is better by more than that
//   fails, too: the documents are stale then.
// - The number of wrong loops is exactly the figure.
// - A share that ought to be 1 may miss it by 15 % more than the figure does, or by a least step:
//   one of the few things that it counts, or two in a thousand.
// - The map's 3D IoU keeps 85 % of its gain over the IoU of the detections.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

namespace sslcd {

// What was measured of one set, e.g. "loops/victoria-park"; SSLCD_FIGURES is the file's path.
class Figures {
 public:
  explicit Figures(const std::string& set) {
    std::ifstream file(SSLCD_FIGURES);
    values_ = nlohmann::json::parse(file).at("sets").at(set).at("figures");
  }

  double Get(const std::string& name) const { return values_.at(name).get<double>(); }

  void ExpectSimilar(const std::string& name, double value) const {
    EXPECT_GE(value, (1 - kSlack) * Get(name)) << name << kMeasureAgain;
    EXPECT_LE(value, (1 + kSlack) * Get(name)) << name << kMeasureAgain;
  }

  void ExpectSame(const std::string& name, double value) const {
    EXPECT_EQ(value, Get(name)) << name << kMeasureAgain;
  }

  void ExpectShare(const std::string& name, double value, double least_step = 0.002) const {
    const double miss = 1 - Get(name);
    EXPECT_LE(1 - value, miss + std::max(kSlack * miss, 1.001 * least_step)) << name;
  }

  void ExpectGain(const std::string& before, const std::string& after, double value) const {
    EXPECT_GE(value - Get(before), (1 - kSlack) * (Get(after) - Get(before))) << after;
  }

 private:
  static constexpr double kSlack = 0.15;
  static constexpr const char* kMeasureAgain =
      " (if it is meant to change: scripts/measure.sh, then scripts/figures_to_docs.sh)";
  nlohmann::json values_;
};

}  // namespace sslcd
