// SPDX-License-Identifier: BSD-3-Clause
#include "change/learning.h"

#include <algorithm>
#include <numeric>

namespace sslcd {
namespace {

constexpr int kRounds = 20;
// Priors, set by hand. In numbers of steps: places that stay and that change, those that are taken
// again and that stay free, steps by which a label is like all labels. In numbers of visits: kinds.
constexpr double kStays = 4, kChanges = 1, kTaken = 1, kFree = 1, kLikeAll = 4;
constexpr VisitKinds kKindsPrior = {{0.5, 0.5, 1, 4, 4}, {8, 1, 0.5}};

double Share(double yes, double no, double prior_yes, double prior_no) {
  return (yes + prior_yes) / (yes + no + prior_yes + prior_no);
}

ChangeRates RatesOf(const StepCounts& n) {
  return {Share(n.leaves, n.stays, kChanges, kStays),
          Share(n.replaced, n.leaves - n.replaced, kTaken, kFree),
          Share(n.arrives, n.stays_empty, kChanges, kStays)};
}

ChangeRates RatesOf(const StepCounts& n, const ChangeRates& all) {
  const auto share = [](double yes, double no, double usual) {
    return Share(yes, no, kLikeAll * usual, kLikeAll * (1 - usual));
  };
  return {share(n.leaves, n.stays, all.departure),
          share(n.replaced, n.leaves - n.replaced, all.replaced),
          share(n.arrives, n.stays_empty, all.arrival)};
}

VisitKinds Normalised(VisitKinds counts) {
  const auto normalise = [](auto& kinds) {
    const double sum = std::accumulate(kinds.begin(), kinds.end(), 0.);
    for (double& kind : kinds) kind /= sum;
  };
  normalise(counts.there);
  normalise(counts.empty);
  return counts;
}

// The looks of different objects: of different places of a label in successive sessions.
LookStatistics LearnOthers(const std::vector<Place>& places) {
  constexpr std::size_t kPairs = 5;  // of each place
  LookStatistics looks = LookStatistics::Prior();
  std::map<std::string, std::vector<const Place*>> labels;
  for (const Place& place : places) labels[place.label].push_back(&place);
  for (const auto& [label, all] : labels) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      for (std::size_t k = 1; k <= std::min(kPairs, all.size() - 1); ++k) {
        const Place &a = *all[i], &b = *all[(i + k) % all.size()];
        for (std::size_t s = 0; s + 1 < a.sessions.size(); ++s) {
          LookPair pair = Compare(a.sessions[s], b.sessions[s + 1], a.symmetry);
          pair.reversed.reset();  // each place has a heading of its own
          looks.other.Add(pair, 1);
        }
      }
    }
  }
  return looks;
}

void Solve(const std::vector<Place>& places, const Learnt& learnt,
           std::vector<PlaceRecord>& records) {
  for (std::size_t i = 0; i < places.size(); ++i) {
    PlaceRecord& record = records[i];
    record.sessions.resize(record.visits.size());
    for (std::size_t s = 0; s < record.sessions.size(); ++s)
      record.sessions[s] = {
          LogThere(record.visits[s], learnt.kinds), LogEmpty(record.visits[s], learnt.kinds),
          places[i].sessions[s].sightings > 0, LogSameObject(record.looks[s], learnt.looks)};
    record.chain = SolveChain(record.sessions, learnt.rates.at(places[i].label), learnt.first);
  }
}

// Adds the looks of a place, by the probabilities that an object is the one of before.
void LearnLooks(const PlaceRecord& record, LookStatistics& looks) {
  for (std::size_t s = 1; s < record.looks.size(); ++s) {
    StateVector state{};  // before the looks of this session become those to compare with
    for (int i = 0; i < kPlaceStates; ++i)
      for (int j = 0; j < kPlaceStates; ++j)
        state[j] += record.chain.states[s - 1][i] * record.chain.steps[s - 1][i][j];
    looks.same.Add(record.looks[s], state[kSame]);
    if (record.looks[s].reversed)
      (*record.looks[s].reversed ? looks.other.reversed : looks.other.not_reversed) +=
          state[kOther];
  }
}

Learnt Learn(const std::vector<Place>& places, const std::vector<PlaceRecord>& records,
             const Learnt& before, const LookStatistics& looks) {
  Learnt learnt;
  learnt.looks = looks;
  std::map<std::string, StepCounts> counts;
  StepCounts all;
  double there = 1, empty = 1;  // in the first session
  VisitKinds kinds = kKindsPrior;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const PlaceRecord& record = records[i];
    const StepCounts n = CountSteps(record.chain, before.rates.at(places[i].label));
    counts[places[i].label] += n;
    all += n;
    LearnLooks(record, learnt.looks);
    empty += record.chain.states.front()[kEmpty];
    there += 1 - record.chain.states.front()[kEmpty];
    for (std::size_t s = 0; s < record.visits.size(); ++s) {
      const double none = record.chain.states[s][kEmpty];
      for (const Visit& visit : record.visits[s]) Count(visit, before.kinds, 1 - none, none, kinds);
    }
  }
  learnt.first = there / (there + empty);
  learnt.kinds = Normalised(kinds);
  for (const auto& [label, n] : counts) learnt.rates[label] = RatesOf(n, RatesOf(all));
  return learnt;
}

}  // namespace

Learnt LearnChanges(const std::vector<Place>& places, std::vector<PlaceRecord>& records) {
  const LookStatistics looks = LearnOthers(places);
  Learnt learnt;
  learnt.looks = looks;
  learnt.kinds = Normalised(kKindsPrior);
  for (const Place& place : places) learnt.rates[place.label] = RatesOf(StepCounts());
  for (int round = 0; round < kRounds; ++round) {
    Solve(places, learnt, records);
    learnt = Learn(places, records, learnt, looks);
  }
  Solve(places, learnt, records);
  return learnt;
}

}  // namespace sslcd
