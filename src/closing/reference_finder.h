// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>

#include "closing/loop_finder.h"
#include "sslcd/closing/localisation.h"

namespace sslcd {

/// Searches each local map in a finished map instead of the global map of the run, tracks poses as
/// MakeTrackFinder does, and gives each answer to `report`. Never finds a loop of the run. The
/// objects of the map need labels and finite positions (CheckReferenceMap).
std::unique_ptr<LoopFinder> MakeReferenceFinder(const LoopOptions& options, const ReferenceMap& map,
                                                std::function<void(const Localisation&)> report);

/// Throws Error(kBadInput) with the first object that is unusable.
void CheckReferenceMap(const ReferenceMap& map);

}  // namespace sslcd
