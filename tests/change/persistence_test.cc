// SPDX-License-Identifier: BSD-3-Clause
#include "change/persistence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace sslcd {
namespace {

constexpr ChangeRates kCars{0.3, 0.5, 0.4};
constexpr ChangeRates kPoles{0.002, 0.1, 0.01};
const SessionLikelihood kSeen{0, -20, true, 0}, kMissed{-20, 0, false, 0},
    kNotInView{0, 0, false, 0};
// should have been seen a few times
const SessionLikelihood kOverlooked{-4, 0, false, 0};
const SessionLikelihood kLooksOther{0, -20, true, -8}, kLooksSame{0, -20, true, 8};

PlaceOutcome Outcome(const std::vector<SessionLikelihood>& sessions, const ChangeRates& rates,
                     int from, int to) {
  return Between(SolveChain(sessions, rates, 0.5), rates, from, to);
}

TEST(Persistence, SeenAgainHasStayed) {
  EXPECT_GT(Outcome({kSeen, kLooksSame}, kCars, 0, 1).stayed, 0.99);
}

TEST(Persistence, MissedThoughInViewHasDeparted) {
  EXPECT_GT(Outcome({kSeen, kMissed}, kCars, 0, 1).departed, 0.99);
  EXPECT_GT(Outcome({kMissed, kSeen}, kCars, 0, 1).arrived, 0.99);
}

TEST(Persistence, OutOfViewOnlyTheRatesTell) {
  const PlaceOutcome cars = Outcome({kSeen, kNotInView}, kCars, 0, 1);
  EXPECT_NEAR(cars.Departure(), kCars.departure, 1e-6);
  EXPECT_NEAR(cars.replaced, kCars.departure * kCars.replaced, 1e-6);
  EXPECT_LT(Outcome({kSeen, kNotInView}, kPoles, 0, 1).Departure(), 0.01);
}

TEST(Persistence, WeakEvidenceConvincesOfCarsAndNotOfPoles) {
  EXPECT_GT(Outcome({kSeen, kOverlooked}, kCars, 0, 1).departed, 0.8);
  EXPECT_LT(Outcome({kSeen, kOverlooked}, kPoles, 0, 1).departed, 0.2);
  // what is seen later says more
  EXPECT_LT(Outcome({kSeen, kOverlooked, kSeen}, kPoles, 0, 1).departed, 0.01);
}

TEST(Persistence, OtherLooksAreAnotherObject) {
  const std::vector<SessionLikelihood> sessions = {kSeen, kLooksOther};
  EXPECT_GT(Outcome(sessions, kCars, 0, 1).replaced, 0.9);
  EXPECT_LT(Outcome({kSeen, {0, -20, true, 0}}, kCars, 0, 1).replaced, 0.2);
}

TEST(Persistence, TheLooksOfTheLastSightingCountOverAGap) {
  EXPECT_GT(Outcome({kSeen, kNotInView, kLooksOther}, kCars, 0, 2).replaced, 0.9);
  EXPECT_GT(Outcome({kSeen, kNotInView, kLooksSame}, kCars, 0, 2).stayed, 0.9);
  // the same looks speak against a departure in between
  EXPECT_GT(Outcome({kSeen, kNotInView, kLooksSame}, kCars, 0, 1).stayed,
            Outcome({kSeen, kNotInView, kSeen}, kCars, 0, 1).stayed);
}

TEST(Persistence, ChangesOverSeveralSessionsAddUp) {
  EXPECT_GT(Outcome({kSeen, kLooksOther, kLooksSame}, kCars, 0, 2).replaced, 0.9);
  EXPECT_GT(Outcome({kSeen, kMissed, kSeen}, kCars, 0, 2).replaced, 0.9);
}

TEST(Persistence, HugeEvidenceStaysFinite) {
  const SessionLikelihood sure{-1e4, -9e3, true, -50};
  const PlaceOutcome outcome = Outcome({sure, {-3e4, -1e3, false, 0}, sure}, kPoles, 0, 2);
  EXPECT_NEAR(outcome.stayed + outcome.Departure() + outcome.arrived + outcome.empty, 1, 1e-9);
}

// All ways in which a place may develop, one by one.
class AllWays {
 public:
  AllWays(std::vector<SessionLikelihood> sessions, const ChangeRates& rates, double first, int from,
          int to)
      : sessions_(std::move(sessions)), rates_(rates), from_(from), to_(to) {
    Go({0}, 1 - first, 0);
    Go({1}, first, 0);
    for (double* p :
         {&outcome.stayed, &outcome.departed, &outcome.replaced, &outcome.arrived, &outcome.empty})
      *p /= all_;
    for (double& p : there) p /= all_;
  }

  PlaceOutcome outcome;
  std::array<double, 8> there{};

 private:
  // `way`: object in each session so far, 0: none. `reference`: the one of the last looks.
  void Go(std::vector<int> way, double p, int reference) {
    const std::size_t s = way.size() - 1;
    const SessionLikelihood& session = sessions_[s];
    const int now = way.back();
    p *= std::exp(now == 0 ? session.log_empty : session.log_there);
    if (session.looks && now > 0) {
      if (reference > 0 && now == reference) p *= std::exp(session.log_same);
      reference = now;
    }
    if (way.size() == sessions_.size()) return Add(way, p);
    const int fresh = static_cast<int>(way.size()) + 1;
    const auto then = [&](int object, double share) {
      std::vector<int> longer = way;
      longer.push_back(object);
      Go(longer, p * share, reference);
    };
    if (now == 0) {
      then(0, 1 - rates_.arrival);
      then(fresh, rates_.arrival);
    } else {
      then(now, 1 - rates_.departure);
      then(0, rates_.departure * (1 - rates_.replaced));
      then(fresh, rates_.departure * rates_.replaced);
    }
  }

  void Add(const std::vector<int>& way, double p) {
    all_ += p;
    for (std::size_t s = 0; s < way.size(); ++s) there[s] += way[s] > 0 ? p : 0;
    const int a = way[from_], b = way[to_];
    (a == 0   ? b == 0 ? outcome.empty : outcome.arrived
     : b == a ? outcome.stayed
     : b == 0 ? outcome.departed
              : outcome.replaced) += p;
  }

  std::vector<SessionLikelihood> sessions_;
  ChangeRates rates_;
  int from_, to_;
  double all_ = 0;
};

// The looks of the first session with an object have nothing to be compared with, so log_same is
// zero there, as learning.cc has it.
TEST(PersistenceProperty, EqualsTheSumOverAllWays) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> rate(0.05, 0.95), evidence(-4, 4);
  for (int round = 0; round < 300; ++round) {
    const ChangeRates rates{rate(random), rate(random), rate(random)};
    std::vector<SessionLikelihood> sessions(2 + round % 4);
    bool compared = false;
    for (SessionLikelihood& session : sessions) {
      session = {evidence(random), evidence(random), random() % 2 == 0, 0};
      // who has looks was seen
      if (session.looks) session.log_empty = session.log_there - 60;
      if (session.looks && compared) session.log_same = evidence(random);
      compared = compared || session.looks;
    }
    const int to = static_cast<int>(sessions.size()) - 1, from = round % to;
    const double first = rate(random);
    const AllWays truth(sessions, rates, first, from, to);
    const PlaceChain chain = SolveChain(sessions, rates, first);
    const PlaceOutcome outcome = Between(chain, rates, from, to);
    EXPECT_NEAR(outcome.stayed, truth.outcome.stayed, 1e-9) << round;
    EXPECT_NEAR(outcome.departed, truth.outcome.departed, 1e-9) << round;
    EXPECT_NEAR(outcome.replaced, truth.outcome.replaced, 1e-9) << round;
    EXPECT_NEAR(outcome.arrived, truth.outcome.arrived, 1e-9) << round;
    EXPECT_NEAR(outcome.empty, truth.outcome.empty, 1e-9) << round;
    for (std::size_t s = 0; s < sessions.size(); ++s)
      EXPECT_NEAR(1 - chain.states[s][kEmpty], truth.there[s], 1e-9) << round;
  }
}

TEST(Persistence, CountsItsSteps) {
  const PlaceChain chain =
      SolveChain({kSeen, kLooksSame, kLooksOther, kMissed, kMissed, kSeen}, kCars, 0.5);
  const StepCounts n = CountSteps(chain, kCars);
  EXPECT_NEAR(n.stays, 1, 0.05);
  EXPECT_NEAR(n.leaves, 2, 0.05);
  EXPECT_NEAR(n.replaced, 1, 0.05);
  EXPECT_NEAR(n.arrives, 1, 0.05);
  EXPECT_NEAR(n.stays_empty, 1, 0.05);
}

}  // namespace
}  // namespace sslcd
