// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace sslcd::apps {

/// Prints one JSON object on stdout: the keys of `facts`, an object, and then `written`, a list of
/// the files with their sizes [bytes]. Paths are as the user gave them.
void PrintWritten(nlohmann::ordered_json facts, const std::vector<std::string>& paths);

}  // namespace sslcd::apps
