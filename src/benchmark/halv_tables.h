// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "benchmark/table.h"
#include "benchmark/trial.h"

namespace sslcd::benchmark {

/// All trials of one method and their results, in the same order.
struct MethodResults {
  Method method;
  std::vector<Trial> trials;
  std::vector<TrialResult> results;
};

/// The paper's Table II: ATE after Sim(3) per case, mean over seeds of a run's RMSE, standard
/// deviation and largest error; the paper's own rows, measured on its own data, below.
Table AteTable(const std::vector<MethodResults>& methods);

/// Recognition of revisiting keyframes per viewpoint bin: recall with Wilson intervals, wrong loops
/// (error above 5 m) and the errors of the other loops. Only accepted loops count.
Table AttemptsTable(const MethodResults& method, const std::string& key, const std::string& title);

/// All accepted loops, one row each: the paper's figure of distance and rotation errors.
Table LoopTable(const std::vector<MethodResults>& methods);

/// Average precision, also per viewpoint bin, and recall at full precision, from all answers by
/// score.
Table PrecisionRecallTable(const std::vector<MethodResults>& methods);

/// The curves, with Wilson intervals.
Table PrecisionRecallCurves(const std::vector<MethodResults>& methods);

/// Recall of what each method accepted in bins of 15 degrees of viewpoint change, with Wilson
/// intervals; bins without a keyframe are left out. One row per bin, one column per method. All
/// methods must have run on the same worlds.
Table ViewpointTable(const std::vector<MethodResults>& methods, const std::string& key);

/// The same with a row for each method and bin, `key`_curves.
Table ViewpointCurves(const std::vector<MethodResults>& methods, const std::string& key);

/// The paper's Table III: times of the stages, with the median over runs of p50 and p95, and the
/// maximum of all.
Table StageTable(const std::vector<TrialResult>& results);

/// ATE, recall and wrong loops of sslcd and of its variants.
Table AblationTable(const std::vector<MethodResults>& methods);

}  // namespace sslcd::benchmark
