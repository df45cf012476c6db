// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "sslcd/core/detection.h"
#include "sslcd/store/map_store.h"
#include "store/database.h"

namespace sslcd {

/// Calls take(landmark, detection) for the sightings of confirmed landmarks, with the detections of
/// the inputs. O(inputs)
void ForEachSighting(Database& database, const std::vector<MapObject>& objects,
                     const std::vector<SessionInfo>& sessions,
                     const std::function<void(int, const Detection&)>& take);

/// Fills the table of appearance: the means of the vectors in the inputs over the sightings of each
/// confirmed landmark. The table must be empty. O(inputs)
void WriteAppearance(Database& database, const std::vector<MapObject>& objects,
                     const std::vector<SessionInfo>& sessions);

}  // namespace sslcd
