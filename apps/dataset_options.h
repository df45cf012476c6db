// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

#include "sslcd/datasets/dataset.h"

namespace sslcd::apps {

/// The options that say which files of DATASET are read: --format, --sequence, --detections and
/// --odometry.
void AddTo(CLI::App& command, DatasetRequest& request);

}  // namespace sslcd::apps
