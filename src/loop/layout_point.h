// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace sslcd {

/// The data of an object for scoring poses.
struct LayoutPoint {
  float x = 0, y = 0, z = 0;  ///< [m]
  int label = 0;
};

}  // namespace sslcd
