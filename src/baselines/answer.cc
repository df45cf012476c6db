// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/answer.h"

namespace sslcd::baselines {

PlaceMatcher AsPlaceMatcher(LayoutMatcher matcher) {
  return [matcher = std::move(matcher)](const PlaceQuery& query) -> std::optional<PlaceAnswer> {
    const std::optional<Answer> found = matcher(query.local, query.global);
    if (!found) return std::nullopt;
    PlaceAnswer answer;
    answer.matches = found->matches;
    answer.score = found->score;
    answer.accepted = found->accepted;
    return answer;
  };
}

}  // namespace sslcd::baselines
