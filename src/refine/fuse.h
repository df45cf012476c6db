// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "map/map_state.h"
#include "sslcd/refine/options.h"

/// Landmarks that turn out to be one object become one: the confirmed one of the two, else the one
/// seen more often, keeps its id and takes the other's sightings and appearance; its pose is the
/// mean of both, weighted by information. The frames' lists of matched landmarks follow.
namespace sslcd {

/// Ids that are gone -> the landmark that each was merged into, which may be gone itself.
using MergedIds = std::map<int, LandmarkId>;
/// The landmark that `id` is part of now; `id` itself where it is not gone.
LandmarkId Resolve(LandmarkId id, const MergedIds& merged);

/// Were both seen in one frame, more often than by a detector's slip? Then they are two objects.
bool SeenTogether(const MapLandmark& a, const MapLandmark& b);

/// The pairs that a loop closure has matched, once map and trajectory have moved, and then every
/// duplicate that this brings to light. Pairs may form chains. Left alone: pairs of an unknown id,
/// of two labels, of objects that drive or that were seen together.
MergedIds FuseMatched(MapState& state, const std::vector<std::pair<LandmarkId, LandmarkId>>& pairs,
                      const WholeMapOptions& options);

/// Confirmed landmarks of one label that stand in one place: no further apart than
/// `refine.duplicate_m`, and than the detector's errors explain or their bodies leave room for. Not
/// those seen together, nor those of two visits that nothing ties to each other yet (see
/// PathSegments).
MergedIds FuseDuplicates(MapState& state, const WholeMapOptions& options);

}  // namespace sslcd
