// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <vector>

namespace sslcd {

/// How much path lies between two points of a trajectory when closed loops count as shortcuts: that
/// is how far odometry may have drifted between them.
class PathGraph {
 public:
  /// The points at `a_m` and `b_m` of the path [m] have been tied together.
  void AddShortcut(double a_m, double b_m);

  /// Shortest way from `from_m` to the other point.
  class Distances {
   public:
    double To(double to_m) const;

   private:
    friend class PathGraph;
    double from_m_ = 0;
    std::map<double, double> distance_;  // of each shortcut's ends
  };
  Distances From(double from_m) const;

 private:
  std::map<double, std::vector<double>> shortcuts_;  // each end -> the others
};

}  // namespace sslcd
