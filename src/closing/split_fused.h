// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "closing/pass_map.h"
#include "sslcd/refine/options.h"

namespace sslcd {

/// Undoes all fusions: splits landmarks into those that their passes belonged to
/// (PassObject::own_id), with the sightings, ids and galleries of these. They are placed where
/// their sightings put them in the current trajectory, and their motion is tested again.
void SplitFused(MapState& state, PassMap& passes, const WholeMapOptions& options);

}  // namespace sslcd
