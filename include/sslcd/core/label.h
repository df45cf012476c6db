// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>

#include "sslcd/core/export.h"

namespace SSLCD_EXPORT sslcd {

/// The rotational symmetry of an object about the vertical.
enum class Symmetry {
  kNone,  ///< front and back differ (car)
  kPi,    ///< front and back are equal or not distinguished
  kFull,  ///< no yaw (pole, tree)
};

/// "none", "pi" or "full".
const char* ToString(Symmetry symmetry);
std::optional<Symmetry> ParseSymmetry(const std::string& text);

/// Period of the yaw in rad: 2 pi, pi, or 0 for "no yaw".
double YawPeriod(Symmetry symmetry);

/// Properties of a class of objects.
struct LabelInfo {
  Symmetry symmetry = Symmetry::kNone;
};

/// Properties by label. Other labels have a default LabelInfo.
class LabelTable {
 public:
  const LabelInfo& operator[](const std::string& label) const;
  void Set(const std::string& label, const LabelInfo& info) { table_[label] = info; }
  const std::map<std::string, LabelInfo>& entries() const { return table_; }

 private:
  std::map<std::string, LabelInfo> table_;
};

}  // namespace sslcd
