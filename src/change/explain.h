// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "change/sightings.h"
#include "sslcd/change/map_history.h"
#include "sslcd/core/export.h"

namespace sslcd {

/// The history of the places of a map, by expectation maximisation: probabilities of the states of
/// each place, and from them the rates of change of each label, the ease of visits and the rate of
/// false sightings, in turns.
SSLCD_EXPORT MapHistory Explain(const Sightings& sightings);

}  // namespace sslcd
