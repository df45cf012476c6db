// SPDX-License-Identifier: BSD-3-Clause
#include "check/outcome.h"

#include <cmath>

#include "formats/number_text.h"

namespace sslcd::check {

std::string Percent(double share) { return FixedNumber(100 * share, 0) + " %"; }

std::string Metres(double value) {
  return (std::abs(value) < 100 ? FixedNumber(value, 2) : RoundedNumber(value, 3)) + " m";
}

std::string Figure(double value, int decimals) { return FixedNumber(value, decimals); }

}  // namespace sslcd::check
