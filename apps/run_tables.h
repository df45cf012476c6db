// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "evaluation.h"
#include "sslcd/pipeline/run.h"

namespace sslcd::apps {

int Landmarks(const RunResult& result);
int LoopsOf(const RunResult& result, LoopDecision decision);

/// Counts and metrics of a run.
std::string ResultTable(const RunResult& result, const Metrics& metrics);

/// Why a run has no loops: what there was to find, how often it was looked for, what refused it.
std::string NoLoopTable(const RunResult& result, const LoopOptions& options, const Vec3& up);

}  // namespace sslcd::apps
