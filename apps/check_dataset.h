// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "check/checks.h"
#include "sslcd/datasets/dataset.h"

namespace sslcd::apps {

/// Tests a dataset that was loaded by `request`. Reads the rows of its detections once more.
check::CheckReport CheckDataset(const DatasetRequest& request, const Dataset& dataset);

/// The same, with a warning for each mistake.
check::CheckReport WarnOfMistakes(const DatasetRequest& request, const Dataset& dataset);

}  // namespace sslcd::apps
