// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "check/outcome.h"

namespace sslcd::check {

/// Embeddings of one object in two frames, told by its place, are more alike than those of two
/// objects in one frame. The statistic is the share of comparisons in which they are (AUC): 0.5 for
/// vectors that say nothing. Needs 100 detections, and for the AUC 60 of each kind.
Outcome CheckEmbeddings(const Sequence& sequence);

}  // namespace sslcd::check
