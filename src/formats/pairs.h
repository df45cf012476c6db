// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "sslcd/core/layout.h"

namespace sslcd {

/// Two maps of one place and the true transform between them: a test case of layout matching.
struct LayoutPair {
  int id = 0;
  std::string scene;  ///< free text, one word
  YawShift truth;     ///< T_global_local
  std::vector<LayoutObject> local, global;
};

/// Reads a text file of such pairs, z up, metres and radians:
///
///   PAIR id scene n_local n_global yaw tx ty tz
///   L identity label x y z      (n_local rows)
///   G identity label x y z      (n_global rows)
/// Labels are whole numbers. The identities (-1: none) are dropped, because no matcher may use
/// them. The objects have no yaw and no size. Throws Error (kBadInput) with file and line for any
/// other row, and for a file without a pair.
std::vector<LayoutPair> ReadLayoutPairs(const std::string& path);

}  // namespace sslcd
