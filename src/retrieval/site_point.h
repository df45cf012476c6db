// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace sslcd {

/// An object as the index stores it: 12 bytes.
struct SitePoint {
  float x = 0, y = 0;       ///< from the origin of the site [m]
  std::uint16_t label = 0;  ///< number of the label in the index
  std::uint16_t unused = 0;
};

/// A horizontal pose: p_to = R(yaw) p_from + (x, y). [rad, m]
struct FlatPose {
  float yaw = 0, x = 0, y = 0;
};

}  // namespace sslcd
