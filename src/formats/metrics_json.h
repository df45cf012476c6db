// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sslcd/core/timing.h"

namespace sslcd {

/// Names and values in the order of printing. A missing value is printed as null.
using Metrics = std::vector<std::pair<std::string, std::optional<double>>>;

/// Returns the text of metrics.json.
std::string MetricsJson(const Metrics& metrics);

/// Returns the text of timing.json: an object per stage.
std::string TimingJson(const TimingTable& timing);

}  // namespace sslcd
