// SPDX-License-Identifier: BSD-3-Clause
#include "check/embeddings.h"

#include <algorithm>

#include "check/world_headings.h"

namespace sslcd::check {
namespace {

constexpr std::size_t kLeastRows = 100, kLeastCosines = 60;
constexpr double kChance = 0.55;    // AUC
constexpr double kEqual = 0.99999;  // cosine of vectors that are the same
constexpr double kEmptyShare = 0.9;

const std::vector<float>& Vector(const Row& row) {
  return row.detection.appearance[Cue::kEmbedding];
}

double Cosine(const Row& a, const Row& b) {
  const std::vector<float>&x = Vector(a), &y = Vector(b);
  double sum = 0;
  for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i) sum += double(x[i]) * y[i];
  return sum;
}

/// The probability that one of `high` is greater than one of `low`.
double Auc(const std::vector<double>& high, std::vector<double> low) {
  std::sort(low.begin(), low.end());
  double sum = 0;
  for (const double value : high) {
    const auto below = std::lower_bound(low.begin(), low.end(), value);
    const auto equal = std::upper_bound(below, low.end(), value);
    sum += static_cast<double>(below - low.begin()) + 0.5 * static_cast<double>(equal - below);
  }
  return sum / (static_cast<double>(high.size()) * static_cast<double>(low.size()));
}

std::vector<double> CosinesInFrames(const Sequence& sequence) {
  std::vector<double> cosines;
  for (const auto& rows : RowsByFrame(sequence))
    for (std::size_t i = 0; i + 1 < rows.size(); ++i)
      if (rows[i]->detection.label == rows[i + 1]->detection.label && !Vector(*rows[i]).empty() &&
          !Vector(*rows[i + 1]).empty())
        cosines.push_back(Cosine(*rows[i], *rows[i + 1]));
  return cosines;
}

}  // namespace

Outcome CheckEmbeddings(const Sequence& sequence) {
  const auto with = std::count_if(sequence.rows.begin(), sequence.rows.end(),
                                  [](const Row& row) { return !Vector(row).empty(); });
  if (!sequence.has_embeddings) return NotTestable("no embeddings");
  if (sequence.rows.size() < kLeastRows)
    return NotTestable("fewer than " + std::to_string(kLeastRows) + " detections");
  if (static_cast<double>(with) < (1 - kEmptyShare) * static_cast<double>(sequence.rows.size()))
    return Found("embeddings_empty", "only " + std::to_string(with) + " of " +
                                         std::to_string(sequence.rows.size()) +
                                         " detections have an embedding that is not 0");
  const std::vector<double> others = CosinesInFrames(sequence);
  if (others.size() >= kLeastCosines && *std::min_element(others.begin(), others.end()) > kEqual)
    return Found("embeddings_constant", "the embeddings of all objects are the same");
  const std::optional<StaticObjects> objects =
      sequence.has_odometry ? FindStaticObjects(sequence) : std::nullopt;
  if (!objects) return NotTestable("too few objects that are seen again");
  std::vector<double> same;
  for (const SameObject& pair : SameObjects(sequence, objects->pairs, objects->cap_m))
    if (!Vector(*pair.before).empty() && !Vector(*pair.after).empty())
      same.push_back(Cosine(*pair.before, *pair.after));
  if (same.size() < kLeastCosines || others.size() < kLeastCosines)
    return NotTestable("fewer than " + std::to_string(kLeastCosines) +
                       " objects that are seen again, or seen together");
  const double auc = Auc(same, others);
  const std::string measured = "one object seen twice is more alike than two objects in " +
                               Percent(auc) + " of the comparisons";
  if (auc > kChance) return Ok(measured);
  return Found("embeddings_shuffled",
               measured + " (50 % is chance): its rows are not those of the detections");
}

}  // namespace sslcd::check
