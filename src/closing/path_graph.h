// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <vector>

namespace sslcd {

/// The path length between two points of a trajectory with closed loops as shortcuts, which
/// determines the drift between them.
class PathGraph {
 public:
  /// Connects the points at the path lengths `a_m` and `b_m` [m].
  void AddShortcut(double a_m, double b_m);

  /// Shortest path from `from_m` to the other point. [m]
  class Distances {
   public:
    double To(double to_m) const;

   private:
    friend class PathGraph;
    double from_m_ = 0;
    std::map<double, double> distance_;  // distance by end of a shortcut
  };
  Distances From(double from_m) const;

 private:
  std::map<double, std::vector<double>> shortcuts_;  // connected ends by end
};

}  // namespace sslcd
