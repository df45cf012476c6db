// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "sslcd/core/landmark.h"

namespace sslcd {

/// Which true objects the landmarks of a map stand for. A landmark belongs to the identity most of
/// its observations have (on a tie, the one observed first).
struct Identities {
  int landmarks = 0;         ///< confirmed ones
  int observations = 0;      ///< of them, those with an identity
  int pure = 0;              ///< of these, those with the identity of their landmark
  std::map<int, int> owned;  ///< identity -> number of landmarks, where there are any

  double Purity() const { return observations > 0 ? static_cast<double>(pure) / observations : 0.; }
};

/// `identity_of_row`: the true identity of a detection row, none for a false alarm.
Identities FindIdentities(const std::vector<MapObject>& objects,
                          const std::function<std::optional<int>(int)>& identity_of_row);

/// The true identity of a detection row. Throws Error (kUsage) if it has none.
int IdentityOfRow(const std::vector<int>& identities, int row);

}  // namespace sslcd
