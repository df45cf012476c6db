// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "sslcd/core/detection.h"

namespace sslcd {

/// Tells when a refinement is due: after a path of `every_m` metres, and of a share of the whole
/// path. The time of a refinement grows with the path: without the share, refinements would take up
/// all time.
class RefinementPlan {
 public:
  /// 0 is never. Throws Error for a negative path or one that is no number.
  explicit RefinementPlan(double every_m);

  /// True if a refinement is due now, and then not before the path has grown again.
  bool Add(const Frame& frame);
  /// The way to the next frame is none.
  void StartSequence() { before_.reset(); }

 private:
  double every_m_;
  double path_m_ = 0, last_m_ = 0;
  std::optional<Pose> before_;
};

}  // namespace sslcd
