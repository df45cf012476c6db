// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "sslcd/change/map_history.h"

namespace sslcd {

/// What is at a place: nothing, the object that was there when its looks were last recorded, or
/// another one.
enum PlaceState { kEmpty, kSame, kOther, kPlaceStates };
using StateVector = std::array<double, kPlaceStates>;
using StateMatrix = std::array<StateVector, kPlaceStates>;

/// The evidence of one session.
struct SessionLikelihood {
  double log_there = 0, log_empty = 0;  ///< of what was seen and what was not
  bool looks = false;                   ///< whether its looks are recorded
  /// log likelihood ratio of "the same object" against "another one" by the looks of this session
  /// and of the last one before it that has some
  double log_same = 0;
};

/// The states of a hidden Markov chain over sessions, given all evidence (forward-backward).
struct PlaceChain {
  std::vector<bool> looks;  ///< SessionLikelihood::looks
  /// P(state after session s). With looks, the object becomes the one to compare with: kSame.
  std::vector<StateVector> states;
  /// P(state of s + 1, before its looks become the reference | state after s)
  std::vector<StateMatrix> steps;
};
/// `first`: probability that an object is there in the first session. At least one session, rates
/// in (0, 1). O(sessions)
PlaceChain SolveChain(const std::vector<SessionLikelihood>& sessions, const ChangeRates& rates,
                      double first);

/// What became of a place between two sessions, `from` before `to`; the rates as in SolveChain.
PlaceOutcome Between(const PlaceChain& chain, const ChangeRates& rates, int from, int to);

/// Expected numbers of steps of each kind, from which rates are learnt.
struct StepCounts {
  double stays = 0, leaves = 0, arrives = 0, stays_empty = 0;
  double replaced = 0;  ///< among those that leave
  StepCounts& operator+=(const StepCounts& other);
};
StepCounts CountSteps(const PlaceChain& chain, const ChangeRates& rates);

}  // namespace sslcd
