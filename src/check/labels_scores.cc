// SPDX-License-Identifier: BSD-3-Clause
#include "check/labels_scores.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

#include "check/world_headings.h"

namespace sslcd::check {
namespace {

constexpr std::size_t kLeastScored = 20;
constexpr double kNoLogit = 30, kMostPercent = 100;
constexpr int kLeastOfLabel = 10, kLeastRound = 30;
constexpr double kRound = 0.02, kRoundShare = 0.95;
constexpr double kAnyHeading = 1.2, kSameObject = 2;  // [rad], [m]
constexpr int kLeastSeenAgain = 20, kMostLabelPairs = 2000;

std::map<std::string, std::vector<const Row*>> RowsByLabel(const Sequence& sequence) {
  std::map<std::string, std::vector<const Row*>> rows;
  for (const Row& row : sequence.rows) rows[row.detection.label].push_back(&row);
  return rows;
}

/// Lower case, letters and digits alone, without a plural's s.
std::string Plain(const std::string& label) {
  std::string plain;
  for (const char c : label)
    if (std::isalnum(static_cast<unsigned char>(c)) != 0)
      plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (plain.size() > 3 && plain.back() == 's') plain.pop_back();
  return plain;
}

std::function<void(Sequence&)> Rename(const std::map<std::string, std::string>& names) {
  return [names](Sequence& s) {
    for (Row& row : s.rows)
      if (const auto it = names.find(row.detection.label); it != names.end())
        row.detection.label = it->second;
  };
}

bool IsRoundWithoutHeading(const std::vector<const Row*>& rows) {
  std::map<double, int> headings;
  int round = 0, most = 0;
  for (const Row* row : rows) {
    const Vec3& dims = row->detection.dims;
    round += std::abs(dims.x() - dims.y()) <= kRound * dims.x() ? 1 : 0;
    most = std::max(most, ++headings[row->written.rotation_y]);
  }
  const double needed = kRoundShare * static_cast<double>(rows.size());
  return round >= needed && most >= needed;
}

/// The mean change of the headings of static objects, by label: pi / 2 where they mean nothing.
std::map<std::string, double> HeadingChanges(const Sequence& sequence) {
  std::map<std::string, std::pair<double, int>> sums;
  if (sequence.has_odometry)
    for (const SameObject& same :
         SameObjects(sequence, PairsAtLag(sequence, 1, kMostLabelPairs), kSameObject)) {
      auto& [sum, count] = sums[same.before->detection.label];
      sum += std::abs(
          WorldTurn(same, same.before->written.rotation_y, same.after->written.rotation_y));
      ++count;
    }
  std::map<std::string, double> changes;
  for (const auto& [label, of_label] : sums)
    if (of_label.second >= kLeastSeenAgain) changes[label] = of_label.first / of_label.second;
  return changes;
}

}  // namespace

Outcome CheckScores(const Sequence& sequence) {
  if (sequence.rows.size() < kLeastScored)
    return NotTestable("fewer than " + std::to_string(kLeastScored) + " detections");
  const auto [least, most] =
      std::minmax_element(sequence.rows.begin(), sequence.rows.end(),
                          [](auto& a, auto& b) { return a.written.score < b.written.score; });
  const std::string measured =
      "scores from " + Figure(least->written.score) + " to " + Figure(most->written.score);
  if (least->written.score < 0 || most->written.score > kMostPercent ||
      most->written.score < kNoLogit)
    return Ok(measured);
  return Found("score_percent", measured + ": per cent, which are read as logits, nearly all 1",
               [](Sequence& s) {
                 for (Row& row : s.rows) {
                   row.written.score /= 100;
                   row.detection.score = row.written.score;
                 }
               });
}

Outcome CheckLabels(const Sequence& sequence) {
  const auto& known = sequence.labels.entries();
  if (known.empty()) return NotTestable("sequence.yaml names no labels");
  std::map<std::string, std::string> names;
  std::string text;
  for (const auto& [label, rows] : RowsByLabel(sequence)) {
    if (known.count(label) > 0 || static_cast<int>(rows.size()) < kLeastOfLabel) continue;
    for (const auto& entry : known) {
      if (Plain(entry.first) != Plain(label)) continue;
      names[label] = entry.first;
      text += (text.empty() ? "" : ", ") + label + " for " + entry.first;
    }
  }
  if (names.empty()) return Ok(std::to_string(known.size()) + " labels in sequence.yaml");
  return Found("unknown_labels", "detections have other spellings than sequence.yaml: " + text,
               Rename(names));
}

Outcome CheckSymmetry(const Sequence& sequence) {
  std::vector<std::string> round;
  std::string text;
  int tested = 0;
  const std::map<std::string, double> changes = HeadingChanges(sequence);
  for (const auto& [label, rows] : RowsByLabel(sequence)) {
    if (static_cast<int>(rows.size()) < kLeastRound) continue;
    ++tested;
    if (sequence.labels[label].symmetry == Symmetry::kFull) continue;
    if (IsRoundWithoutHeading(rows)) {
      round.push_back(label);
      text += "; " + label + " is as long as wide and has one rotation_y in all rows";
    } else if (const auto change = changes.find(label);
               change != changes.end() && change->second > kAnyHeading) {
      round.push_back(label);
      text += "; the heading of a static " + label + " changes by " + Figure(change->second) +
              " rad from frame to frame (" + Figure(M_PI / 2) + " is chance)";
    }
  }
  if (tested == 0)
    return NotTestable("no label has " + std::to_string(kLeastRound) + " detections");
  if (round.empty()) return Ok(std::to_string(tested) + " labels tested");
  return Found("no_symmetry", text.substr(2), [round](Sequence& s) {
    for (const Row& row : s.rows)  // once there are labels, all of them are
      s.labels.Set(row.detection.label, s.labels[row.detection.label]);
    for (const std::string& label : round) s.labels.Set(label, {Symmetry::kFull});
  });
}

}  // namespace sslcd::check
