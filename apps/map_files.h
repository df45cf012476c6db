// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "sslcd/retrieval/site_index.h"

namespace sslcd::apps {

/// The maps that a path names: a file; the map.json of a run folder; or all *.db files of a folder
/// and the map.json of each run folder in it, by name. Throws Error(kBadInput) if there is none.
std::vector<std::string> MapFiles(const std::string& path);

/// Throws Error(kUsage) if a map is named twice, under the same or another name.
void RefuseTwice(const std::vector<std::string>& files);

/// The landmarks of a map.json, or of a map of sslcd::store. Throws Error(kBadInput) if it is no
/// map.
Site ReadMapFile(const std::string& file);

}  // namespace sslcd::apps
