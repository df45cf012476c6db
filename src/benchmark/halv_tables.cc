// SPDX-License-Identifier: BSD-3-Clause
#include "benchmark/halv_tables.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <set>

#include "benchmark/paper_figures.h"
#include "eval/wilson.h"

namespace sslcd::benchmark {
namespace {

constexpr double kTrueLoop = 5.;  // the paper's tau_L [m]
constexpr double kDegrees = 180 / M_PI;
constexpr int kAllBins = kViewpointBins;

double Mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return values.empty() ? 0. : sum / static_cast<double>(values.size());
}

double Median(std::vector<double> values) { return Summarise(std::move(values)).median; }

std::set<int> CasesOf(const std::vector<MethodResults>& methods) {
  std::set<int> cases;
  for (const MethodResults& method : methods)
    for (const Trial& trial : method.trials) cases.insert(trial.case_number);
  return cases;
}

bool InBin(double viewpoint_rad, int bin) {
  return bin == kAllBins || ViewpointBin(viewpoint_rad) == bin;
}

std::string BinName(int bin) { return bin == kAllBins ? "all" : kViewpointBinNames[bin]; }

// Whether an accepted and correct loop recognised the keyframe.
bool Recognised(const Revisit& revisit, const std::vector<LoopOutcome>& loops) {
  const double near = RevisitOptions().spacing_m;
  return std::any_of(loops.begin(), loops.end(), [&](const LoopOutcome& loop) {
    return loop.accepted && loop.error_m < kTrueLoop && std::abs(loop.at_m - revisit.at_m) <= near;
  });
}

struct Counts {
  int revisits = 0, recognised = 0, loops = 0, wrong = 0, off_1m = 0;
  std::vector<double> errors_m, errors_rad;  // errors of correct loops
};

Counts CountBin(const std::vector<TrialResult>& results, int bin) {
  Counts counts;
  for (const TrialResult& result : results) {
    for (const Revisit& revisit : result.revisits) {
      if (!InBin(revisit.viewpoint_rad, bin)) continue;
      ++counts.revisits;
      counts.recognised += Recognised(revisit, result.loops);
    }
    for (const LoopOutcome& loop : result.loops) {
      if (!loop.accepted || !InBin(loop.viewpoint_rad, bin)) continue;
      ++counts.loops;
      counts.wrong += loop.error_m >= kTrueLoop;
      counts.off_1m += loop.error_m >= 1.;
      if (loop.error_m >= kTrueLoop) continue;
      counts.errors_m.push_back(loop.error_m);
      counts.errors_rad.push_back(loop.error_rad);
    }
  }
  return counts;
}

std::string Share(int part, int whole) {
  return whole == 0 ? "" : Cell("%.3f", static_cast<double>(part) / static_cast<double>(whole));
}

std::string IntervalCell(int part, int whole) {
  if (whole == 0) return "";
  const Interval interval = WilsonInterval(part, whole);
  return Cell("%.3f", interval.low) + " to " + Cell("%.3f", interval.high);
}

constexpr int kStep = 15, kSteps = 180 / kStep;  // of ViewpointTable [deg]
using ViewpointCounts = std::array<Counts, kSteps>;

std::string StepName(int bin) {
  return std::to_string(bin * kStep) + "-" + std::to_string((bin + 1) * kStep);
}

ViewpointCounts CountViewpoints(const std::vector<TrialResult>& results) {
  ViewpointCounts counts;
  for (const TrialResult& result : results)
    for (const Revisit& revisit : result.revisits) {
      const int bin = static_cast<int>(revisit.viewpoint_rad * kDegrees / kStep);
      Counts& of_bin = counts[std::min(bin, kSteps - 1)];
      ++of_bin.revisits;
      of_bin.recognised += Recognised(revisit, result.loops);
    }
  return counts;
}

PrecisionRecall CurveOf(const MethodResults& method, int bin) {
  std::vector<ScoredAnswer> answers;
  int positives = 0;
  for (const TrialResult& result : method.results) {
    for (const ScoredAnswer& answer : AnswersOf(result.revisits, result.loops, kTrueLoop))
      if (InBin(answer.viewpoint_change_rad, bin)) answers.push_back(answer);
    for (const Revisit& revisit : result.revisits) positives += InBin(revisit.viewpoint_rad, bin);
  }
  return ComputePrecisionRecall(answers, positives);
}

}  // namespace

Table AteTable(const std::vector<MethodResults>& methods) {
  Table table{"table2",
              "ATE after Sim(3) [m]: mean over seeds of RMSE, standard deviation and largest error",
              {"method"},
              {}};
  const std::set<int> cases = CasesOf(methods);
  for (const int c : cases)
    for (const char* what : {" RMSE", " STD", " max"})
      table.header.push_back(std::to_string(c) + what);
  table.header.insert(table.header.end(), {"mean RMSE", "largest RMSE", "largest error"});
  // By case: the figures of each run.
  const auto add = [&](const std::string& title,
                       const std::function<std::vector<std::array<double, 3>>(int)>& runs_of) {
    std::vector<std::string> row{title};
    std::vector<double> means;
    double largest_rmse = 0, largest_error = 0;
    for (const int c : cases) {
      std::array<std::vector<double>, 3> columns;
      for (const auto& run : runs_of(c)) {
        for (int i = 0; i < 3; ++i) columns[i].push_back(run[i]);
        largest_rmse = std::max(largest_rmse, run[0]);
        largest_error = std::max(largest_error, run[2]);
      }
      for (const auto& column : columns) row.push_back(Cell("%.3f", Mean(column)));
      means.push_back(Mean(columns[0]));
    }
    row.insert(row.end(), {Cell("%.3f", Mean(means)), Cell("%.3f", largest_rmse),
                           Cell("%.3f", largest_error)});
    table.rows.push_back(std::move(row));
  };
  const auto add_measured = [&](const std::string& title, const MethodResults& method,
                                ErrorStats TrialResult::*ate) {
    add(title, [&](int c) {
      std::vector<std::array<double, 3>> runs;
      for (std::size_t i = 0; i < method.results.size(); ++i) {
        const ErrorStats& error = method.results[i].*ate;
        if (method.trials[i].case_number == c) runs.push_back({error.rmse, error.std, error.max});
      }
      return runs;
    });
  };
  for (const MethodResults& method : methods)
    add_measured(method.method.title, method, &TrialResult::ate);
  if (!methods.empty())
    add_measured("the odometry as it comes", methods[0], &TrialResult::ate_odometry);
  for (const PaperAteRow& paper : kPaperAte)
    add(std::string(paper.method) + " (the paper's figures, on HALV)",
        [&](int c) { return std::vector<std::array<double, 3>>{paper.cases[c - 1]}; });
  return table;
}

Table AttemptsTable(const MethodResults& method, const std::string& key, const std::string& title) {
  Table table{key,
              title,
              {"viewpoint [deg]", "keyframes to recognise", "recognised", "recall", "95 %", "loops",
               "off by > 5 m", "off by > 1 m", "median error [m]", "median error [deg]"},
              {}};
  for (int bin = 0; bin <= kAllBins; ++bin) {
    const Counts c = CountBin(method.results, bin);
    const bool any = !c.errors_m.empty();
    table.rows.push_back({BinName(bin), std::to_string(c.revisits), std::to_string(c.recognised),
                          Share(c.recognised, c.revisits), IntervalCell(c.recognised, c.revisits),
                          std::to_string(c.loops), std::to_string(c.wrong),
                          std::to_string(c.off_1m), any ? Cell("%.3f", Median(c.errors_m)) : "",
                          any ? Cell("%.2f", Median(c.errors_rad) * kDegrees) : ""});
  }
  return table;
}

Table LoopTable(const std::vector<MethodResults>& methods) {
  Table table{"loops",
              "Every loop that was accepted",
              {"method", "place", "case", "seed", "path_m", "score", "viewpoint_deg", "error_m",
               "error_deg"},
              {}};
  for (const MethodResults& method : methods)
    for (std::size_t i = 0; i < method.results.size(); ++i)
      for (const LoopOutcome& loop : method.results[i].loops) {
        if (!loop.accepted) continue;
        const Trial& trial = method.trials[i];
        table.rows.push_back({method.method.key, trial.place.key, std::to_string(trial.case_number),
                              std::to_string(trial.seed), Cell("%.1f", loop.at_m),
                              Cell("%.3f", loop.score), Cell("%.1f", loop.viewpoint_rad * kDegrees),
                              Cell("%.3f", loop.error_m), Cell("%.2f", loop.error_rad * kDegrees)});
      }
  return table;
}

Table PrecisionRecallTable(const std::vector<MethodResults>& methods) {
  Table table{"pr",
              "Average precision by viewpoint change [deg], and recall without a wrong answer",
              {"method"},
              {}};
  for (int bin = 0; bin <= kAllBins; ++bin) table.header.push_back("AP " + BinName(bin));
  table.header.insert(table.header.end(), {"keyframes", "recall at precision 1", "95 %"});
  for (const MethodResults& method : methods) {
    std::vector<std::string> row{method.method.title};
    for (int bin = 0; bin <= kAllBins; ++bin) {
      const PrecisionRecall curve = CurveOf(method, bin);
      row.push_back(curve.positives > 0 ? Cell("%.3f", curve.average_precision) : "");
    }
    const PrecisionRecall all = CurveOf(method, kAllBins);
    const int found = static_cast<int>(std::lround(all.recall_at_full_precision * all.positives));
    row.push_back(std::to_string(all.positives));
    row.push_back(Cell("%.3f", all.recall_at_full_precision));
    row.push_back(IntervalCell(found, all.positives));
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table PrecisionRecallCurves(const std::vector<MethodResults>& methods) {
  Table table{"pr_curves",
              "Precision and recall of what scores at least the threshold",
              {"method", "viewpoint_deg", "threshold", "answered", "correct", "precision",
               "precision_low", "precision_high", "recall", "recall_low", "recall_high"},
              {}};
  for (const MethodResults& method : methods)
    for (int bin = 0; bin <= kAllBins; ++bin)
      for (const PrecisionRecallPoint& point : CurveOf(method, bin).curve)
        table.rows.push_back(
            {method.method.key, BinName(bin), Cell("%.4f", point.threshold),
             std::to_string(point.answered), std::to_string(point.correct),
             Cell("%.4f", point.precision), Cell("%.4f", point.precision_interval.low),
             Cell("%.4f", point.precision_interval.high), Cell("%.4f", point.recall),
             Cell("%.4f", point.recall_interval.low), Cell("%.4f", point.recall_interval.high)});
  return table;
}

Table ViewpointTable(const std::vector<MethodResults>& methods, const std::string& key) {
  Table table{key,
              "Share of keyframes recognised by change of viewpoint, and its 95 % interval",
              {"viewpoint [deg]", "keyframes"},
              {}};
  std::vector<ViewpointCounts> counts;
  for (const MethodResults& method : methods) {
    table.header.push_back(method.method.title);
    counts.push_back(CountViewpoints(method.results));
  }
  for (int bin = 0; bin < kSteps && !methods.empty(); ++bin) {
    if (counts[0][bin].revisits == 0) continue;
    std::vector<std::string> row{StepName(bin), std::to_string(counts[0][bin].revisits)};
    for (const ViewpointCounts& of_method : counts) {
      const Counts& c = of_method[bin];
      row.push_back(Share(c.recognised, c.revisits) + " (" +
                    IntervalCell(c.recognised, c.revisits) + ")");
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table ViewpointCurves(const std::vector<MethodResults>& methods, const std::string& key) {
  Table table{
      key + "_curves",
      "Keyframes recognised over the change of viewpoint",
      {"method", "viewpoint_deg", "keyframes", "recognised", "recall", "recall_low", "recall_high"},
      {}};
  for (const MethodResults& method : methods) {
    const ViewpointCounts counts = CountViewpoints(method.results);
    for (int bin = 0; bin < kSteps; ++bin) {
      const Counts& c = counts[bin];
      if (c.revisits == 0) continue;
      const Interval interval = WilsonInterval(c.recognised, c.revisits);
      table.rows.push_back({method.method.key, StepName(bin), std::to_string(c.revisits),
                            std::to_string(c.recognised), Share(c.recognised, c.revisits),
                            Cell("%.3f", interval.low), Cell("%.3f", interval.high)});
    }
  }
  return table;
}

Table StageTable(const std::vector<TrialResult>& results) {
  Table table{"table3",
              "Times of the stages [ms]",
              {"stage", "calls a run", "p50", "p95", "max", "the paper (i7-9700)"},
              {}};
  std::set<std::string> stages;
  for (const TrialResult& result : results)
    for (const auto& [stage, times] : result.times) stages.insert(stage);
  for (const std::string& stage : stages) {
    std::vector<double> count, p50, p95, largest;
    for (const TrialResult& result : results) {
      const auto times = result.times.find(stage);
      if (times == result.times.end()) continue;
      count.push_back(times->second.count);
      p50.push_back(times->second.p50);
      p95.push_back(times->second.p95);
      largest.push_back(times->second.max);
    }
    const auto paper = std::find_if(kPaperTimes.begin(), kPaperTimes.end(),
                                    [&](const auto& p) { return p.stage == stage; });
    table.rows.push_back({stage, Cell("%.0f", Mean(count)), Cell("%.3f", Median(p50)),
                          Cell("%.2f", Median(p95)),
                          Cell("%.1f", *std::max_element(largest.begin(), largest.end())),
                          paper == kPaperTimes.end() ? "" : Cell("%.1f", paper->ms)});
  }
  return table;
}

Table AblationTable(const std::vector<MethodResults>& methods) {
  Table table{"ablation", "What each part is good for", {"variant"}, {}};
  const std::set<int> cases = CasesOf(methods);
  for (const int c : cases) table.header.push_back("ATE case " + std::to_string(c) + " [m]");
  table.header.insert(table.header.end(),
                      {"mean [m]", "largest [m]", "recall", "loops", "off by > 5 m"});
  for (const MethodResults& method : methods) {
    std::vector<std::string> row{method.method.title};
    std::vector<double> means;
    double largest = 0;
    for (const int c : cases) {
      std::vector<double> rmse;
      for (std::size_t i = 0; i < method.results.size(); ++i)
        if (method.trials[i].case_number == c) rmse.push_back(method.results[i].ate.rmse);
      means.push_back(Mean(rmse));
      row.push_back(Cell("%.3f", means.back()));
    }
    for (const TrialResult& result : method.results) largest = std::max(largest, result.ate.rmse);
    const Counts counts = CountBin(method.results, kAllBins);
    row.insert(row.end(), {Cell("%.3f", Mean(means)), Cell("%.3f", largest),
                           Share(counts.recognised, counts.revisits), std::to_string(counts.loops),
                           std::to_string(counts.wrong)});
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace sslcd::benchmark
