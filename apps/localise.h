// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "console.h"
#include "sslcd/closing/localisation.h"
#include "sslcd/datasets/dataset.h"

namespace sslcd::apps {

/// A stretch of a drive, by the options --from and --frames.
struct StretchArguments {
  int from = 0;    ///< first frame
  int frames = 0;  ///< largest number of frames; 0: all
};
void AddTo(CLI::App& command, StretchArguments& stretch);

/// Throws Error(kUsage) if there is no such frame.
std::vector<Frame> StretchOf(const Dataset& dataset, const StretchArguments& stretch);

/// An attempt, with the stamp of its frame.
struct Attempt {
  Localisation found;
  double stamp = 0;
};
bool IsFound(const Attempt& attempt);

/// Searches the stretch in the map of a file; ends after the first answer if `first`. Throws
/// Error(kBadInput) if the file is no map or that of another kind of data.
std::vector<Attempt> LocaliseInMap(const std::string& map, const Dataset& dataset,
                                   const std::vector<Frame>& stretch, bool first,
                                   const Console& console);

}  // namespace sslcd::apps
