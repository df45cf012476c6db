// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/core/label.h"

#include <cmath>

namespace sslcd {

const char* ToString(Symmetry symmetry) {
  switch (symmetry) {
    case Symmetry::kNone: return "none";
    case Symmetry::kPi: return "pi";
    case Symmetry::kFull: return "full";
  }
  return "?";
}

std::optional<Symmetry> ParseSymmetry(const std::string& text) {
  for (const Symmetry symmetry : {Symmetry::kNone, Symmetry::kPi, Symmetry::kFull})
    if (text == ToString(symmetry)) return symmetry;
  return std::nullopt;
}

double YawPeriod(Symmetry symmetry) {
  switch (symmetry) {
    case Symmetry::kNone: return 2 * M_PI;
    case Symmetry::kPi: return M_PI;
    case Symmetry::kFull: return 0;
  }
  return 0;
}

const LabelInfo& LabelTable::operator[](const std::string& label) const {
  static const LabelInfo kUnknown;
  const auto it = table_.find(label);
  return it == table_.end() ? kUnknown : it->second;
}

}  // namespace sslcd
