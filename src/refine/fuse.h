// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "map/map_state.h"
#include "sslcd/refine/options.h"

/// Fuses duplicate landmarks. The confirmed one of the two, otherwise the one with more sightings,
/// keeps its id and gets the other's sightings and appearance. Its pose is the information-weighted
/// mean of both. The frames' lists of matched landmarks get the new id.
namespace sslcd {

/// Merged ids and the landmark that replaced each; that one may be merged itself.
using MergedIds = std::map<int, LandmarkId>;
/// The current landmark of `id`; `id` itself if it was not merged.
LandmarkId Resolve(LandmarkId id, const MergedIds& merged);

/// Whether both were seen in the same frames, more often than by detector errors. Then they are two
/// objects.
bool SeenTogether(const MapLandmark& a, const MapLandmark& b);

/// Fuses the pairs that a loop closure has matched, after map and trajectory have moved, and then
/// all duplicates that this reveals. Pairs may form chains. Ignores pairs with an unknown id,
/// different labels, driving objects, or objects seen together.
MergedIds FuseMatched(MapState& state, const std::vector<std::pair<LandmarkId, LandmarkId>>& pairs,
                      const WholeMapOptions& options);

/// Fuses confirmed landmarks of the same label at the same place: closer than `refine.duplicate_m`,
/// and closer than the detector's errors explain or than their sizes allow. Excludes landmarks seen
/// together, and landmarks of passes that are not linked yet (see PathSegments).
MergedIds FuseDuplicates(MapState& state, const WholeMapOptions& options);

}  // namespace sslcd
