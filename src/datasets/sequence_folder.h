// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "datasets/dataset_reader.h"

namespace sslcd {

/// The parts of a sequence folder (docs/formats.md); KITTI odometry's sequences are such folders,
/// too.
DatasetLayout FindSequenceFolder(const std::string& folder);

}  // namespace sslcd
