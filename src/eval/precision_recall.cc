// SPDX-License-Identifier: BSD-3-Clause
#include "eval/precision_recall.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "sslcd/core/error.h"
#include "sslcd/core/pose.h"

namespace sslcd {
namespace {

void Check(const std::vector<ScoredAnswer>& answers, int positives) {
  int correct = 0;
  for (const ScoredAnswer& answer : answers) {
    if (std::isnan(answer.score))
      throw Error(ErrorKind::kUsage, "the score of an answer is not a number");
    correct += answer.correct;
  }
  if (correct > positives) {
    throw Error(ErrorKind::kUsage, std::to_string(correct) + " answers are correct, but only " +
                                       std::to_string(positives) + " exist: count each one once");
  }
}

}  // namespace

PrecisionRecall ComputePrecisionRecall(std::vector<ScoredAnswer> answers, int positives) {
  Check(answers, positives);
  std::sort(answers.begin(), answers.end(),
            [](const ScoredAnswer& a, const ScoredAnswer& b) { return a.score > b.score; });
  PrecisionRecall result;
  result.positives = positives;
  PrecisionRecallPoint point;
  double last_recall = 0;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    ++point.answered;
    point.correct += answers[i].correct;
    // equal scores have no threshold between them
    if (i + 1 < answers.size() && answers[i + 1].score == answers[i].score) continue;
    point.threshold = answers[i].score;
    point.precision = static_cast<double>(point.correct) / point.answered;
    point.recall = positives > 0 ? static_cast<double>(point.correct) / positives : 0.;
    point.precision_interval = WilsonInterval(point.correct, point.answered);
    point.recall_interval = WilsonInterval(point.correct, positives);
    result.curve.push_back(point);
    result.average_precision += (point.recall - last_recall) * point.precision;
    if (point.correct == point.answered) result.recall_at_full_precision = point.recall;
    last_recall = point.recall;
  }
  return result;
}

int ViewpointBin(double viewpoint_change_rad) {
  const double degrees = std::abs(WrapAngle(viewpoint_change_rad)) * 180 / M_PI;
  return std::min(static_cast<int>(degrees / 45), kViewpointBins - 1);
}

std::array<PrecisionRecall, kViewpointBins> ComputePrecisionRecallByViewpoint(
    const std::vector<ScoredAnswer>& answers, const std::array<int, kViewpointBins>& positives) {
  std::array<std::vector<ScoredAnswer>, kViewpointBins> binned;
  for (const ScoredAnswer& answer : answers) {
    if (!std::isfinite(answer.viewpoint_change_rad)) {
      throw Error(ErrorKind::kUsage, "the viewpoint change of an answer is not finite");
    }
    binned[ViewpointBin(answer.viewpoint_change_rad)].push_back(answer);
  }
  std::array<PrecisionRecall, kViewpointBins> results;
  for (int k = 0; k < kViewpointBins; ++k)
    results[k] = ComputePrecisionRecall(std::move(binned[k]), positives[k]);
  return results;
}

}  // namespace sslcd
