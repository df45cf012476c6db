// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "check/outcome.h"

namespace sslcd::check {

/// A mistake that is looked for.
struct MistakeInfo {
  const char* id;
  const char* meaning;  ///< what the file has, completes "the data have ..."
  const char* fix;      ///< file, key or command to change
  bool repairable;      ///< whether the data tell how to correct it
};

/// A test of a sequence.
struct Check {
  const char* name;
  const char* statistic;  ///< what is measured
  const char* samples;    ///< what it needs at least
  std::vector<MistakeInfo> mistakes;
  Outcome (*run)(const Sequence& sequence);
};

/// All tests, in order.
const std::vector<Check>& Checks();

/// Throws std::out_of_range for an unknown id.
const MistakeInfo& MistakeOf(const std::string& id);

struct CheckReport {
  struct Line {
    std::string check;
    Outcome outcome;
  };
  std::vector<Line> lines;
  /// with all mistakes corrected that can be
  Sequence repaired;

  int mistakes() const;
};

/// Runs all tests. What one finds and can correct is corrected before the next one runs, so a
/// mistake is reported once.
CheckReport CheckSequence(Sequence sequence);

}  // namespace sslcd::check
