// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <utility>
#include <vector>

#include "sslcd/pipeline/mapper.h"

namespace sslcd {

std::string LoopSearchSummary::Text() const {
  std::string text =
      std::to_string(searches) + " searches, " + std::to_string(accepted) + " loops accepted";
  std::vector<std::pair<int, std::string>> reasons;
  for (const auto& [reason, count] : refused) reasons.push_back({count, reason});
  if (without_candidate > 0)
    reasons.push_back({without_candidate, "too few objects in sight, or in the map, agree"});
  std::sort(reasons.begin(), reasons.end(), [](const auto& a, const auto& b) {
    return a.first != b.first ? a.first > b.first : a.second < b.second;
  });
  for (const auto& [count, reason] : reasons) text += "; " + std::to_string(count) + ": " + reason;
  if (!up_axis_is_plausible)
    text += "; the cameras turn about another axis than the given up axis, so it is wrong";
  return text;
}

}  // namespace sslcd
