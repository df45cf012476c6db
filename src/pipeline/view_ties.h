// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pipeline/path_graph.h"
#include "sslcd/pipeline/mapper.h"

namespace sslcd {

/// Ties cameras of different passes whose images show the same ground, wherever closed loops say roughly where they
/// stand. Loops of objects are right to some decimetres, since cuboids lack the same side on a whole pass; images are
/// right to a centimetre, once it is known where to look.
/// `path`: the accepted loops are its shortcuts. In order of the later camera, one tie each at most.
std::vector<ViewTie> TieViews(const std::vector<FrameRecord>& frames, const PathGraph& path, const ViewAligner& align,
                              const LoopViewOptions& options);

}  // namespace sslcd
