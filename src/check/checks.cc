// SPDX-License-Identifier: BSD-3-Clause
#include "check/checks.h"

#include <algorithm>
#include <stdexcept>

namespace sslcd::check {

const MistakeInfo& MistakeOf(const std::string& id) {
  for (const Check& check : Checks())
    for (const MistakeInfo& mistake : check.mistakes)
      if (id == mistake.id) return mistake;
  throw std::out_of_range("no mistake " + id);
}

int CheckReport::mistakes() const {
  return static_cast<int>(std::count_if(lines.begin(), lines.end(), [](const Line& line) {
    return line.outcome.status == Outcome::Status::kMistake;
  }));
}

CheckReport CheckSequence(Sequence sequence) {
  CheckReport report;
  for (const Check& check : Checks()) {
    report.lines.push_back({check.name, check.run(sequence)});
    const Outcome& outcome = report.lines.back().outcome;
    if (outcome.mistake && outcome.mistake->repair) outcome.mistake->repair(sequence);
  }
  report.repaired = std::move(sequence);
  return report;
}

}  // namespace sslcd::check
