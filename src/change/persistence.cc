// SPDX-License-Identifier: BSD-3-Clause
#include "change/persistence.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace sslcd {
namespace {

StateMatrix Transition(const ChangeRates& r) {
  const double leaves = r.departure * (1 - r.replaced), other = r.departure * r.replaced;
  return {
      {{1 - r.arrival, 0, r.arrival}, {leaves, 1 - r.departure, other}, {leaves, 0, 1 - leaves}}};
}

// Likelihoods of the states before the reference changes, up to a factor.
StateVector Emission(const SessionLikelihood& s) {
  const double same = s.log_there + (s.looks ? s.log_same : 0);
  const double most = std::max({s.log_empty, same, s.log_there});
  return {std::exp(s.log_empty - most), std::exp(same - most), std::exp(s.log_there - most)};
}

StateVector AfterLooks(const StateVector& state, bool looks) {
  return looks ? StateVector{state[kEmpty], state[kSame] + state[kOther], 0} : state;
}

int After(int state, bool looks) { return looks && state == kOther ? kSame : state; }

void Normalise(StateVector& v) {
  const double sum = v[0] + v[1] + v[2];
  for (double& value : v) value /= sum;
}

// P(the object of before is still there | a step from state i to j). From kOther to kOther it is,
// or a third one stands there.
double Stays(const ChangeRates& r, int i, int j) {
  if (i == kSame) return j == kSame ? 1 : 0;
  if (i != kOther || j != kOther) return 0;
  return (1 - r.departure) / (1 - r.departure * (1 - r.replaced));
}

}  // namespace

PlaceChain SolveChain(const std::vector<SessionLikelihood>& sessions, const ChangeRates& rates,
                      double first) {
  assert(!sessions.empty());
  const StateMatrix T = Transition(rates);
  const std::size_t n = sessions.size();
  PlaceChain chain;
  for (const SessionLikelihood& session : sessions) chain.looks.push_back(session.looks);
  // backward: likelihood of all later sessions, by the state after session s
  std::vector<StateVector> later(n, {1, 1, 1}), emission(n);
  for (std::size_t s = n; s-- > 0;) {
    emission[s] = Emission(sessions[s]);
    if (s + 1 == n) continue;
    for (int i = 0; i < kPlaceStates; ++i) {
      later[s][i] = 0;
      for (int j = 0; j < kPlaceStates; ++j)
        later[s][i] += T[i][j] * emission[s + 1][j] * later[s + 1][After(j, sessions[s + 1].looks)];
    }
    Normalise(later[s]);
  }
  // forward: P(state | all sessions), step by step given the later ones
  StateVector before = {1 - first, first, 0};
  for (std::size_t s = 0; s < n; ++s) {
    if (s > 0) {
      StateMatrix step;
      StateVector next = {0, 0, 0};
      for (int i = 0; i < kPlaceStates; ++i) {
        for (int j = 0; j < kPlaceStates; ++j)
          step[i][j] = T[i][j] * emission[s][j] * later[s][After(j, sessions[s].looks)];
        const double sum = step[i][0] + step[i][1] + step[i][2];
        for (int j = 0; j < kPlaceStates; ++j) {
          step[i][j] = sum > 0 ? step[i][j] / sum : T[i][j];
          next[j] += before[i] * step[i][j];
        }
      }
      chain.steps.push_back(step);
      before = AfterLooks(next, sessions[s].looks);
    } else {
      for (int i = 0; i < kPlaceStates; ++i)
        before[i] *= emission[0][i] * later[0][After(i, sessions[0].looks)];
      Normalise(before);
      before = AfterLooks(before, sessions[0].looks);
    }
    chain.states.push_back(before);
  }
  return chain;
}

PlaceOutcome Between(const PlaceChain& chain, const ChangeRates& rates, int from, int to) {
  // P(case and state): the object of `from` is still there, it has gone, there was none
  enum { kThere, kGone, kNone, kCases };
  std::array<StateVector, kCases> now{};
  now[kThere] = chain.states[from];
  now[kNone][kEmpty] = std::exchange(now[kThere][kEmpty], 0);
  for (int s = from; s < to; ++s) {
    std::array<StateVector, kCases> next{};
    for (int i = 0; i < kPlaceStates; ++i) {
      for (int j = 0; j < kPlaceStates; ++j) {
        const int state = After(j, chain.looks[s + 1]);
        const double stays = Stays(rates, i, j);
        next[kThere][state] += now[kThere][i] * chain.steps[s][i][j] * stays;
        next[kGone][state] += now[kThere][i] * chain.steps[s][i][j] * (1 - stays);
        for (const int other : {kGone, kNone})
          next[other][state] += now[other][i] * chain.steps[s][i][j];
      }
    }
    now = next;
  }
  PlaceOutcome outcome;
  outcome.stayed = now[kThere][kSame] + now[kThere][kOther];
  outcome.departed = now[kGone][kEmpty];
  outcome.replaced = now[kGone][kSame] + now[kGone][kOther];
  outcome.arrived = now[kNone][kSame] + now[kNone][kOther];
  outcome.empty = now[kNone][kEmpty];
  return outcome;
}

StepCounts& StepCounts::operator+=(const StepCounts& other) {
  stays += other.stays;
  leaves += other.leaves;
  arrives += other.arrives;
  stays_empty += other.stays_empty;
  replaced += other.replaced;
  return *this;
}

StepCounts CountSteps(const PlaceChain& chain, const ChangeRates& rates) {
  StepCounts counts;
  for (std::size_t s = 0; s < chain.steps.size(); ++s) {
    for (int i = 0; i < kPlaceStates; ++i) {
      for (int j = 0; j < kPlaceStates; ++j) {
        const double p = chain.states[s][i] * chain.steps[s][i][j];
        if (i == kEmpty) {
          (j == kEmpty ? counts.stays_empty : counts.arrives) += p;
          continue;
        }
        const double stays = Stays(rates, i, j);
        counts.stays += p * stays;
        counts.leaves += p * (1 - stays);
        if (j != kEmpty) counts.replaced += p * (1 - stays);
      }
    }
  }
  return counts;
}

}  // namespace sslcd
