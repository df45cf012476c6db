// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "change/views.h"

namespace sslcd {

/// The share of views with a detection, by bearing, range, visible share and label: a detector's
/// field of view, range and reliability as a map tells them. Learnt from objects that certainly
/// stand there: those with two other sightings in the session.
class DetectionRate {
 public:
  /// `views` as CollectViews returns them.
  DetectionRate(const std::vector<Place>& places, const std::vector<std::vector<Views>>& views);

  /// In (0, 1).
  double At(const View& view, const std::string& label) const;

 private:
  struct Count {
    double seen = 0, all = 0;
  };
  static constexpr int kLevels = 5;  // from all views to the cells
  using Cell = std::array<int, kLevels>;
  std::array<Cell, kLevels> CellsOf(const View& view, const std::string& label) const;

  std::map<std::string, int> labels_;
  double range_m_ = 1;  // the largest
  std::map<Cell, Count> counts_;
};

}  // namespace sslcd
