// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "check/sequence.h"

namespace sslcd::check {

/// A mistake that the data show.
struct Mistake {
  std::string id;        ///< one of Mistakes()
  std::string evidence;  ///< with figures, and those of the alternative that was tried
  /// corrects the mistake; empty: no data can say how. Of a mistake that is not `repairable`, it
  /// leaves out what other tests could not use.
  std::function<void(Sequence&)> repair;
};

/// The answer of one test: at most one mistake.
struct Outcome {
  enum class Status { kOk, kNotTestable, kMistake };
  Status status = Status::kOk;
  std::string text;  ///< what was measured, or why nothing could be
  std::optional<Mistake> mistake;
};

inline Outcome Ok(std::string text) { return {Outcome::Status::kOk, std::move(text), {}}; }
inline Outcome NotTestable(std::string why) {
  return {Outcome::Status::kNotTestable, std::move(why), {}};
}
inline Outcome Found(std::string id, std::string evidence,
                     std::function<void(Sequence&)> repair = {}) {
  std::string text = evidence;
  return {Outcome::Status::kMistake, std::move(text),
          Mistake{std::move(id), std::move(evidence), std::move(repair)}};
}

/// Figures in messages.
std::string Percent(double share);
std::string Metres(double value);
std::string Figure(double value, int decimals = 2);

}  // namespace sslcd::check
