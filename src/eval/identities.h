// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "sslcd/core/landmark.h"

namespace sslcd {

/// The true identities of the landmarks of a map. A landmark has the most frequent identity of its
/// observations (on a tie, the one observed first).
struct Identities {
  int landmarks = 0;         ///< confirmed landmarks
  int observations = 0;      ///< observations with an identity
  int pure = 0;              ///< observations that have the identity of their landmark
  std::map<int, int> owned;  ///< number of landmarks by identity, if there are any

  double Purity() const { return observations > 0 ? static_cast<double>(pure) / observations : 0.; }
};

/// `identity_of_row` returns the true identity of a detection row; none for a false alarm.
Identities FindIdentities(const std::vector<MapObject>& objects,
                          const std::function<std::optional<int>(int)>& identity_of_row);

/// The true identity of a detection row. Throws Error (kUsage) if it has none.
int IdentityOfRow(const std::vector<int>& identities, int row);

}  // namespace sslcd
