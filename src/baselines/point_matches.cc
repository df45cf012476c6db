// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/point_matches.h"

#include <map>
#include <memory>

#include "formats/text_rows.h"

namespace sslcd::baselines {
namespace {

// The point matches of two images.
struct Sum {
  int matches = 0;
  double confidence = 0;
};
using Scores = std::map<int, std::map<int, Sum>>;  // query frame -> match frame

Scores ReadPointMatches(const std::string& file) {
  Scores scores;
  TextRows rows(file);
  while (rows.Next()) {
    if (rows.size() != 3)
      rows.Fail("expected 3 columns, query_frame match_frame confidence, but there are " +
                std::to_string(rows.size()));
    const int query = rows.Integer(0), match = rows.Integer(1);
    const double confidence = rows.Number(2);
    if (match < 0 || match >= query)
      rows.Fail("frame " + std::to_string(match) + " is matched with frame " +
                std::to_string(query) + ": a match is an earlier frame, and frames count from 0");
    if (!(confidence >= 0 && confidence <= 1))
      rows.Fail("a confidence lies in [0, 1]; divide by the largest one");
    Sum& sum = scores[query][match];
    ++sum.matches;
    sum.confidence += confidence;
  }
  return scores;
}

}  // namespace

void DescribeFields(FieldVisitor& visitor, PointMatchOptions& options) {
  visitor.Integer("least_matches", options.least_matches, 1, 100000,
                  "point matches that two images need");
  visitor.Real("accept_score", options.accept_score, 0, 1, "a loop has at least this score");
}

PlaceMatcher PointMatchMatcher(const std::string& file, const PointMatchOptions& options) {
  const auto scores = std::make_shared<const Scores>(ReadPointMatches(file));
  return [scores, options](const PlaceQuery& query) -> std::optional<PlaceAnswer> {
    const auto matches = scores->find(query.frame);
    if (matches == scores->end()) return std::nullopt;
    PlaceAnswer best;
    for (const auto& [frame, sum] : matches->second) {
      if (frame > query.old_frame || sum.matches < options.least_matches) continue;
      const double score = sum.confidence / sum.matches;
      if (best.match_frame < 0 || score > best.score) {
        best.match_frame = frame;
        best.score = score;
      }
    }
    if (best.match_frame < 0) return std::nullopt;
    best.accepted = best.score >= options.accept_score;
    return best;
  };
}

}  // namespace sslcd::baselines
