// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "sslcd/core/export.h"
#include "sslcd/core/layout.h"

namespace sslcd {

/// The appearance of a landmark: the paper's H_k and E_k with bounded memory. Eqs. 5 and 6 average
/// the dot product with every past vector, which is O(n) and dominated by the most frequent side.
/// The average of dot products equals the dot product with the average, so `kMean` keeps only the
/// average (same value, O(1)). `kByViewpoint` keeps one average per viewing direction and compares
/// with the bin nearest to the current one.
class SSLCD_EXPORT Gallery {
 public:
  enum class Mode { kMean, kByViewpoint };

  explicit Gallery(Mode mode = Mode::kByViewpoint) : mode_(mode) {}

  /// Adds a vector seen from `viewpoint_rad`, the bearing of the camera in the object frame (0:
  /// from the front). All vectors of a gallery have the same length; an empty vector or one of
  /// another length is ignored.
  void Add(const std::vector<float>& vector, double viewpoint_rad);

  /// Similarity of a vector seen from `viewpoint_rad` in [0, 1] (negative dot products count as 0).
  /// None while either is empty.
  std::optional<double> Compare(const std::vector<float>& vector, double viewpoint_rad) const;

  /// Returns the mean vector of each viewing direction with sightings. The dot product of two views
  /// is the mean of the dot products of their sightings.
  std::vector<AppearanceView> Views() const;

  /// Adds the vectors of another gallery (fusion of two landmarks) with viewpoints rotated by
  /// `turn_rad`.
  void Merge(const Gallery& other, double turn_rad = 0.);

 private:
  // 45 degrees each: a range of viewpoints with similar appearance
  static constexpr int kBins = 8;
  struct Bin {
    std::vector<float> sum;
    int count = 0;
  };
  int BinOf(double viewpoint_rad) const;
  double CentreOf(int bin) const;
  const Bin* NearestFilled(int bin) const;

  Mode mode_;
  std::vector<Bin> bins_;
};

}  // namespace sslcd
