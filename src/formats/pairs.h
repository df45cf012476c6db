// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
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

/// Pairs of a file, which may share one global map.
struct LayoutPairFile {
  std::optional<std::vector<LayoutObject>> map;  ///< of all pairs, which have no `global` then
  std::vector<LayoutPair> pairs;
};

/// Reads a text file of such pairs, z up, metres and radians:
///
///   MAP n_global                (only in a file of queries to one map, first)
///   G identity label x y z      (n_global rows)
///   PAIR id scene n_local n_global yaw tx ty tz
///   L identity label x y z      (n_local rows)
///   G identity label x y z      (n_global rows, none in a file with a MAP)
/// Labels are whole numbers. The identities (-1: none) are dropped, because no matcher may use
/// them. The objects have no yaw and no size. Throws Error (kBadInput) with file and line for any
/// other row, and for a file without a pair.
LayoutPairFile ReadLayoutPairFile(const std::string& path);

/// The pairs of a file without a MAP.
std::vector<LayoutPair> ReadLayoutPairs(const std::string& path);

}  // namespace sslcd
