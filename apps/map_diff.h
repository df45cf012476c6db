// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "console.h"

namespace sslcd::apps {

struct MapDiffArguments {
  std::string from, to;  ///< names of sessions; empty: the last that see common ground
  std::string csv;       ///< file to write; empty: none
  bool json = false;
};

/// Prints what has changed between two sessions of the map in a file.
void PrintMapDiff(const std::string& file, const MapDiffArguments& arguments,
                  const Console& console);

}  // namespace sslcd::apps
