// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <vector>

#include "change/detection_rate.h"

namespace sslcd {

/// Kinds of visits, which differ in the probability of a sighting in each view. Where an object is:
/// factors on the detection rate, since some are hard to see from one side, and some are
/// overlooked, because of what no map knows. Where none is: false sightings, of neighbours for
/// example.
inline constexpr std::array<double, 5> kEase = {0.02, 0.3, 0.6, 0.9, 1.1};
inline constexpr std::array<double, 3> kFalseRates = {0.003, 0.05, 0.2};
/// Of each kind: log likelihoods, or probabilities of sum 1.
using ByEase = std::array<double, kEase.size()>;
using ByFalseRate = std::array<double, kFalseRates.size()>;

/// A time during which a place was in view.
struct Visit {
  int views = 0, seen = 0;
  double expected = 0;  ///< mean number of sightings of an object that is there
  /// log likelihoods of what was seen and what was not, if an object is there, and if none is
  ByEase there{};
  ByFalseRate empty{};
};

/// Splits the views of a place in one session into visits. O(views)
std::vector<Visit> VisitsOf(const Views& views, const std::string& label,
                            const DetectionRate& rate);

/// How frequent each kind of visit is.
struct VisitKinds {
  ByEase there{};
  ByFalseRate empty{};
};

/// Log likelihoods of a session: each of its visits is of a kind of its own.
double LogThere(const std::vector<Visit>& visits, const VisitKinds& kinds);
double LogEmpty(const std::vector<Visit>& visits, const VisitKinds& kinds);

/// Adds the probabilities of the kinds of a visit, times a weight for each of both cases.
void Count(const Visit& visit, const VisitKinds& kinds, double there, double empty,
           VisitKinds& counts);

}  // namespace sslcd
