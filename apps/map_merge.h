// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "console.h"

namespace sslcd::apps {

struct MapMergeArguments {
  std::vector<std::string> from;  ///< maps whose sessions are added
  std::string out;                ///< new file; empty: the first map itself
  bool rename = false, refine_once = false;

  void AddTo(CLI::App& command);
};

/// Adds the sessions of other maps to the map in a file. Returns the exit code.
int MergeInto(const std::string& file, const MapMergeArguments& arguments, const Console& console);

}  // namespace sslcd::apps
