// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "change/evidence.h"
#include "change/looks.h"
#include "change/persistence.h"
#include "change/places.h"

namespace sslcd {

/// What is known of a place, and what follows from it.
struct PlaceRecord {
  std::vector<std::vector<Visit>> visits;  ///< of each session
  std::vector<LookPair> looks;  ///< of each session against the last one before with sightings
  std::vector<SessionLikelihood> sessions;
  PlaceChain chain;
};

/// What is learnt over all places of a map.
struct Learnt {
  double first = 0.5;  ///< probability that an object is there in the first session
  VisitKinds kinds;
  std::map<std::string, ChangeRates> rates;  ///< by label
  LookStatistics looks;
};

/// Expectation maximisation: the states of all places by what is learnt, and what is learnt by the
/// states, in turns. Fills `sessions` and `chain` of the records, which are those of the places in
/// order. O(rounds * sessions * places)
Learnt LearnChanges(const std::vector<Place>& places, std::vector<PlaceRecord>& records);

}  // namespace sslcd
