// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace sslcd::sim {

/// Streams of one seed (see Random), so that a change of one noise setting changes nothing else.
enum Stream {
  kWorldStream = 0,
  kOdometryStream = 1,
  kDetectorStream = 2,
  kPathStream = 3,
  kAppearanceStream = 4,
  kChurnStream = 5,
  kDriftStream = 6,
  kWanderStream = 7,
};

}  // namespace sslcd::sim
