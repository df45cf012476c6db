// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datasets/dataset_reader.h"
#include "sslcd/datasets/dataset.h"

namespace sslcd {

/// Finds out the format and the parts. Throws Error when the folder is none of the known kinds,
/// when the sequence is unknown or must be chosen, when a requested path does not exist, and when
/// odometry or detections are missing.
DatasetLayout FindDatasetLayout(const DatasetRequest& request);

}  // namespace sslcd
