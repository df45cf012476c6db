// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "datasets/dataset_reader.h"
#include "sslcd/datasets/dataset.h"

namespace sslcd {

/// Detects the format and finds the parts. Throws Error if the folder has no known format, if the
/// sequence is unknown or must be chosen, if a requested path does not exist, or if odometry or
/// detections are missing.
DatasetLayout FindDatasetLayout(const DatasetRequest& request);

/// What Dataset::parts says of a layout.
std::vector<std::pair<std::string, std::string>> PartsOf(const DatasetLayout& layout);

}  // namespace sslcd
