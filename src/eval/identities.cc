// SPDX-License-Identifier: BSD-3-Clause
#include "eval/identities.h"

#include <algorithm>
#include <string>
#include <utility>

#include "sslcd/core/error.h"

namespace sslcd {

Identities FindIdentities(const std::vector<MapObject>& objects,
                          const std::function<std::optional<int>(int)>& identity_of_row) {
  Identities result;
  for (const MapObject& object : objects) {
    if (object.state != LandmarkState::kConfirmed) continue;
    ++result.landmarks;
    std::vector<std::pair<int, int>>
        votes;  // (identity, count), in the order of first sightinginginginging
    for (const Observation& observation : object.observations) {
      const std::optional<int> identity = identity_of_row(observation.detection_row);
      if (!identity) continue;
      ++result.observations;
      const auto vote = std::find_if(votes.begin(), votes.end(),
                                     [&](const auto& v) { return v.first == *identity; });
      if (vote == votes.end()) {
        votes.emplace_back(*identity, 1);
      } else {
        ++vote->second;
      }
    }
    if (votes.empty()) continue;
    const auto winner =
        std::max_element(votes.begin(), votes.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
    result.pure += winner->second;
    ++result.owned[winner->first];
  }
  return result;
}

int IdentityOfRow(const std::vector<int>& identities, int row) {
  if (row < 0 || row >= static_cast<int>(identities.size())) {
    throw Error(ErrorKind::kUsage,
                "detection row " + std::to_string(row) + " has no true identity: there are " +
                    std::to_string(identities.size()) + " identities, one per row from 0");
  }
  return identities[row];
}

}  // namespace sslcd
