// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "sslcd/pipeline/mapper.h"

/// Landmarks that turn out to be one object become one: the confirmed one of the two, else the one
/// seen more often, keeps its id and takes the other's sightings and appearance; its pose is the
/// mean of both, weighted by information. The frames' lists of matched landmarks follow.
namespace sslcd {

/// Who took over from landmarks that are gone, by their ids. An heir may be gone itself.
using Heirs = std::map<int, LandmarkId>;
// the last one; `id` itself where it is not gone
LandmarkId HeirOf(LandmarkId id, const Heirs& heirs);

/// Were both seen in one frame, more often than by a detector's slip? Then they are two objects.
bool SeenTogether(const MapLandmark& a, const MapLandmark& b);

/// The pairs that a loop closure has matched, once map and trajectory have moved, and then every
/// duplicate that this brings to light. Pairs may form chains. Left alone: pairs of an unknown id,
/// of two labels, of objects that drive or that were seen together.
Heirs FuseMatched(ObjectMap& map, std::vector<FrameRecord>& frames,
                  const std::vector<std::pair<LandmarkId, LandmarkId>>& pairs,
                  const Options& options);

/// Confirmed landmarks of one label that stand in one place: no further apart than
/// `refine.duplicate_m`, and than the detector's errors explain or their bodies leave room for. Not
/// those seen together, nor those of two visits that nothing ties to each other yet (see
/// Stretches).
Heirs FuseDuplicates(ObjectMap& map, std::vector<FrameRecord>& frames, const Options& options);

}  // namespace sslcd
