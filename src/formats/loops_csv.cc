// SPDX-License-Identifier: BSD-3-Clause
#include "formats/loops_csv.h"

#include <algorithm>
#include <cmath>

#include "formats/csv.h"
#include "formats/number_text.h"
#include "formats/pose_text.h"

namespace sslcd {

std::string LoopsCsv(const std::vector<LoopClosure>& loops) {
  constexpr double kDegrees = 180 / M_PI;
  std::string text =
      "query_frame,match_frame,decision,reason,score,probability,second_score,matches,"
      "viewpoint_change_deg,tx,ty,tz,qx,qy,qz,qw,pairs\n";
  for (const LoopClosure& loop : loops) {
    text += std::to_string(loop.query_frame) + "," + std::to_string(loop.match_frame) + "," +
            ToString(loop.decision) + "," + CsvField(loop.reason) + "," +
            FixedNumber(loop.score, 3) + "," +
            (loop.probability ? FixedNumber(*loop.probability, 6) : "") + "," +
            FixedNumber(loop.second_score, 3) + "," + std::to_string(loop.pairs.size()) + "," +
            FixedNumber(loop.viewpoint_change_rad * kDegrees, 2);
    std::string pose = PoseText(loop.T_match_query);
    std::replace(pose.begin(), pose.end(), ' ', ',');
    text += "," + pose + ",";
    for (std::size_t i = 0; i < loop.pairs.size(); ++i)
      text += (i > 0 ? ";" : "") + std::to_string(loop.pairs[i].first.value) + ":" +
              std::to_string(loop.pairs[i].second.value);
    text += "\n";
  }
  return text;
}

}  // namespace sslcd
