// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sslcd/core/timing.h"

namespace sslcd {

/// Name and value, in the order in which they are printed; no value becomes null.
using Metrics = std::vector<std::pair<std::string, std::optional<double>>>;

/// metrics.json.
std::string MetricsJson(const Metrics& metrics);

/// timing.json: an object for each stage.
std::string TimingJson(const TimingTable& timing);

}  // namespace sslcd
