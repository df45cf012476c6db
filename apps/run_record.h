// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "console.h"
#include "formats/run_json.h"
#include "sslcd/datasets/dataset.h"

namespace sslcd::apps {

/// What the program knows about a run of `dataset` that ends now: all of RunRecord but `complete`,
/// `counts` and `files`. `others` are inputs beside the dataset, as (role, path); empty paths are
/// left out. Images are counted, not hashed.
RunRecord RecordRun(const Dataset& dataset,
                    const std::vector<std::pair<std::string, std::string>>& others,
                    const Console& console);

/// Throws Error(kUsage) if `folder` holds the files of a run that another command has made, or that
/// no run.json explains. Options that change no result (--force, --json, ...) do not make another
/// command.
void RefuseOtherRun(const std::string& folder);

}  // namespace sslcd::apps
