// SPDX-License-Identifier: BSD-3-Clause
#include "formats/loops_csv.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "formats/csv.h"
#include "formats/number_text.h"
#include "formats/pose_text.h"
#include "formats/text_rows.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

constexpr double kDegrees = 180 / M_PI;
constexpr const char* kColumns =
    "query_frame,match_frame,decision,reason,score,probability,second_score,matches,"
    "viewpoint_change_deg,tx,ty,tz,qx,qy,qz,qw,pairs";
constexpr std::size_t kColumnCount = 17;

class LoopRow {
 public:
  LoopRow(const std::string& path, const CsvRow& row) : path_(path), row_(row) {
    if (row.fields.size() != kColumnCount)
      Fail("has " + std::to_string(row.fields.size()) + " columns, expected 17");
  }

  LoopClosure Read() const {
    LoopClosure loop;
    loop.query_frame = Integer(row_.fields[0]);
    loop.match_frame = Integer(row_.fields[1]);
    loop.decision = Decision();
    loop.reason = row_.fields[3];
    loop.score = Number(row_.fields[4]);
    if (!row_.fields[5].empty()) loop.probability = Number(row_.fields[5]);
    loop.second_score = Number(row_.fields[6]);
    loop.viewpoint_change_rad = Number(row_.fields[8]) / kDegrees;
    double pose[7];  // x y z, then the quaternion
    for (std::size_t i = 0; i < 7; ++i) pose[i] = Number(row_.fields[9 + i]);
    std::copy(pose, pose + 3, loop.T_match_query.data() + 4);
    std::copy(pose + 3, pose + 7, loop.T_match_query.data());
    const double length = std::hypot(std::hypot(pose[3], pose[4]), std::hypot(pose[5], pose[6]));
    if (!(std::abs(length - 1) <= kRotationTolerance)) Fail("expected a quaternion of length 1");
    loop.T_match_query.normalise();
    ReadPairs(loop);
    return loop;
  }

 private:
  [[noreturn]] void Fail(const std::string& message) const {
    throw Error(ErrorKind::kBadInput, {path_, row_.line}, message);
  }

  double Number(std::string_view text) const {
    const auto value = ParseNumber(text);
    if (!value) Fail("'" + std::string(text) + "' is no number");
    return *value;
  }

  int Integer(std::string_view text) const {
    const double value = Number(text);
    if (!(value == std::floor(value) && std::abs(value) < 1e9))
      Fail("'" + std::string(text) + "' is no whole number");
    return static_cast<int>(value);
  }

  LoopDecision Decision() const {
    for (const LoopDecision decision :
         {LoopDecision::kNone, LoopDecision::kAmbiguous, LoopDecision::kAccepted})
      if (row_.fields[2] == ToString(decision)) return decision;
    Fail("unknown decision '" + row_.fields[2] + "'");
  }

  void ReadPairs(LoopClosure& loop) const {
    std::string_view rest = row_.fields[16];
    while (!rest.empty()) {
      const std::string_view pair = rest.substr(0, rest.find(';'));
      const std::size_t colon = pair.find(':');
      if (colon == std::string_view::npos) Fail("'" + std::string(pair) + "' is no pair of ids");
      loop.pairs.push_back({{Integer(pair.substr(0, colon))}, {Integer(pair.substr(colon + 1))}});
      rest.remove_prefix(std::min(rest.size(), pair.size() + 1));
    }
  }

  const std::string& path_;
  const CsvRow& row_;
};

}  // namespace

std::string LoopsCsv(const std::vector<LoopClosure>& loops) {
  std::string text = std::string(kColumns) + "\n";
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

std::vector<LoopClosure> ReadLoopsCsv(const std::string& path) {
  const std::vector<CsvRow> rows = ReadCsv(path);
  std::string header;
  for (std::size_t i = 0; !rows.empty() && i < rows[0].fields.size(); ++i)
    header += (i > 0 ? "," : "") + rows[0].fields[i];
  if (header != kColumns)
    throw Error(ErrorKind::kBadInput, {path, 1},
                std::string("is not the loops.csv of a run; expected the columns ") + kColumns);
  std::vector<LoopClosure> loops;
  for (std::size_t i = 1; i < rows.size(); ++i) loops.push_back(LoopRow(path, rows[i]).Read());
  return loops;
}

}  // namespace sslcd
