// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "datasets/dataset_reader.h"

namespace sslcd {

/// Finds the parts of a sequence folder (docs/formats.md). The sequences of KITTI odometry are such
/// folders.
DatasetLayout FindSequenceFolder(const std::string& folder);

}  // namespace sslcd
