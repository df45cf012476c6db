// SPDX-License-Identifier: BSD-3-Clause
#include "bench_tables.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "bench_kitti.h"
#include "bench_writer.h"
#include "benchmark/foreign.h"
#include "benchmark/halv_tables.h"
#include "benchmark/results.h"
#include "formats/file_lock.h"
#include "progress.h"
#include "sslcd/config/config.h"
#include "sslcd/core/error.h"
#include "sslcd_commit.h"

namespace sslcd::apps {
namespace {

using benchmark::Method;
using benchmark::MethodResults;
using benchmark::Place;
using benchmark::Table;
using benchmark::Trial;
using benchmark::TrialResult;

baselines::BaselineOptions LoadBaselines(const std::string& file) {
  baselines::BaselineOptions options;
  if (!file.empty())
    LoadConfigFile(file, [&](FieldVisitor& visitor) { DescribeFields(visitor, options); });
  return options;
}

std::string Dump(baselines::BaselineOptions options) {
  return DumpConfig([&](FieldVisitor& visitor) { DescribeFields(visitor, options); }, false);
}

class Bench {
 public:
  Bench(const BenchArguments& arguments, const Console& console)
      : arguments_(arguments),
        console_(console),
        baselines_(LoadBaselines(arguments.baselines)),
        lock_(LockFolder(arguments.out)),
        folder_(arguments.out, SSLCD_COMMIT, Dump(baselines_)) {}

  // The requested tables, in the order of the paper.
  BenchResults Run() {
    const std::vector<std::pair<std::string, void (Bench::*)()>> all = {
        {"table1", &Bench::Table1},
        {"table2", &Bench::Table2},
        {"table3", &Bench::Table3},
        {"attempts", &Bench::Attempts},
        {"pr", &Bench::Pr},
        {"viewpoint", &Bench::Viewpoint},
        {"ablation", &Bench::Ablation}};
    CheckOptions();
    for (const auto& [name, run] : all)
      if (Asked(name)) (this->*run)();
    return writer_.Finish();
  }

 private:
  bool Asked(const std::string& table) const { return arguments_.Asks(table); }
  void Write(Table table, const std::vector<Table>& curves = {}) {
    writer_.Write(std::move(table), arguments_.cases, curves);
  }

  // Reports mistakes at once, not after hours of runs.
  void CheckOptions() {
    writer_.CheckPlaces();
    if (Asked("viewpoint")) AddViewpoints();
    if (!Asked("table2") && !Asked("pr") && !Asked("viewpoint")) return;
    for (const Method& method : Chosen())
      if (method.key == "appearance")
        CheckRendered(arguments_.images, TrialsOf(viewpoints_, method, true));
  }

  // A range that is given twice, in any spelling, counts once.
  void AddViewpoints() {
    for (const std::string& range : arguments_.viewpoints) {
      Place place = benchmark::PlaceAtViewpoint(range);
      const auto same = [&](const Place& other) { return other.key == place.key; };
      if (std::none_of(viewpoints_.begin(), viewpoints_.end(), same))
        viewpoints_.push_back(std::move(place));
    }
  }

  void Table1() {
    if (arguments_.kitti.empty()) {
      if (arguments_.name != "all")
        throw Error(ErrorKind::kUsage,
                    "table1 is of real data: give --kitti FOLDER, of KITTI's tracking benchmark");
      console_.Say("table1: left out, for there is no --kitti FOLDER\n");
      return;
    }
    Table table = KittiTable(arguments_.kitti, arguments_.detections, {}, Interrupted);
    if (table.rows.empty()) throw BenchStopped();
    writer_.Write(std::move(table), {});
  }

  void Table2() {
    std::vector<MethodResults> foreign;  // read first, to report mistakes before the runs
    for (const std::string& given : arguments_.trajectories) foreign.push_back(Foreign(given));
    std::vector<MethodResults> results = Results({Places()[0]}, Chosen(), false);
    for (MethodResults& other : foreign) results.push_back(std::move(other));
    Write(AteTable(results));
  }

  // The trajectories of another system on the same sequences: "NAME=FOLDER", one file per sequence,
  // e.g. lot-c1-s7.txt.
  MethodResults Foreign(const std::string& given) const {
    const std::size_t equals = given.find('=');
    if (equals == std::string::npos || equals == 0)
      throw Error(ErrorKind::kUsage, "--trajectories " + given + ": write NAME=FOLDER");
    MethodResults foreign;
    foreign.method.key = foreign.method.title = given.substr(0, equals);
    for (Trial& trial : TrialsOf({Places()[0]}, foreign.method, false)) {
      const std::string file = given.substr(equals + 1) + "/" + trial.World() + ".txt";
      TrialResult result;
      result.ate = benchmark::ForeignAte(file, MakeSequence(trial).scene.world.truth);
      foreign.results.push_back(result);
      foreign.trials.push_back(std::move(trial));
    }
    return foreign;
  }

  // Times are measured with one run at a time; --threads does not change this.
  void Table3() {
    std::vector<Trial> trials;
    for (int seed = 1; seed <= arguments_.seeds; ++seed) {
      Trial& trial = trials.emplace_back();
      trial.case_number = 1;
      trial.seed = static_cast<std::uint64_t>(seed);
      trial.method = benchmark::Methods()[0];
      trial.method.key += "-timed";
    }
    writer_.Write(StageTable(RunAll(trials, 1)), {1});
  }

  void Attempts() {
    std::vector<MethodResults> all;
    const std::vector<Place> places = Places();
    for (const Place& place : places) {
      const MethodResults results = Results({place}, {benchmark::Methods()[0]}, false)[0];
      const std::string key = place.key == "lot" ? "attempts" : "attempts_" + place.key;
      all.push_back(results);
      const bool last = all.size() == places.size();
      Write(AttemptsTable(results, key, "sslcd: keyframes recognised and loops, " + TitleOf(place)),
            last ? std::vector<Table>{LoopTable(all)} : std::vector<Table>{});
    }
  }

  void Pr() {
    const std::vector<MethodResults> results = Answers({Places()[0]});
    Write(PrecisionRecallTable(results), {PrecisionRecallCurves(results)});
  }

  // The four cases, and small loops whose passes meet at angles that the cases seldom have.
  void Viewpoint() {
    const std::vector<MethodResults> results = Answers(viewpoints_);
    const std::string key = arguments_.images.empty() ? "viewpoint" : "viewpoint_images";
    Write(ViewpointTable(results, key), {ViewpointCurves(results, key)});
  }

  void Ablation() { Write(AblationTable(Results({Places()[0]}, benchmark::Ablations(), false))); }

  // The methods whose answers have a score: sslcd itself, and the matchers that run on maps without
  // loops.
  std::vector<MethodResults> Answers(const std::vector<Place>& places) {
    std::vector<Method> full, asked;
    for (const Method& method : Chosen()) {
      if (method.matcher) asked.push_back(method);
      if (method.key == "sslcd") full.push_back(method);
    }
    if (!arguments_.matches.empty())
      asked.push_back(benchmark::PointMatchMethod(arguments_.matches, baselines_.point_matches));
    if (full.empty() && asked.empty())
      throw Error(ErrorKind::kUsage,
                  "none of --methods has answers to be scored: take sslcd, or one with a matcher");
    std::vector<MethodResults> results = Results(places, full, false);
    for (MethodResults& method : Results(places, asked, true)) results.push_back(std::move(method));
    return results;
  }

  std::vector<Method> Chosen() const {
    std::vector<Method> methods = benchmark::Methods(baselines_);
    if (!arguments_.images.empty())
      methods.push_back(benchmark::AppearanceMethod(arguments_.images, baselines_.appearance));
    return benchmark::Select(methods, arguments_.methods);
  }

  // The car park, the same car park with other cars on the second pass, and a real layout if given.
  std::vector<Place> Places() const {
    std::vector<Place> places(2);
    places[1].key = "churn";
    places[1].scene.churn = 0.3;
    if (arguments_.layout.empty()) return places;
    Place& real = places.emplace_back();
    real.key = "layout-" + std::filesystem::path(arguments_.layout).stem().string();
    real.scene.layout = arguments_.layout;
    return places;
  }

  std::string TitleOf(const Place& place) const {
    if (place.key == "churn") return "car park with 30 % of the cars changed between the passes";
    return place.key == "lot" ? "generated car park" : place.key;
  }

  std::vector<Trial> TrialsOf(const std::vector<Place>& places, const Method& method,
                              bool only_asked) const {
    std::vector<Trial> trials;
    for (const Place& place : places)
      for (const int c : place.cases.empty() ? arguments_.cases : place.cases)
        for (int seed = 1; seed <= arguments_.seeds; ++seed)
          trials.push_back({place, c, static_cast<std::uint64_t>(seed), method, only_asked});
    return trials;
  }

  std::vector<MethodResults> Results(const std::vector<Place>& places,
                                     const std::vector<Method>& methods, bool only_asked) {
    std::vector<Trial> trials;
    for (const Method& method : methods)
      for (Trial& trial : TrialsOf(places, method, only_asked)) trials.push_back(std::move(trial));
    const std::vector<TrialResult> results = RunAll(trials, arguments_.threads);
    std::vector<MethodResults> sorted;
    const std::size_t each = methods.empty() ? 0 : trials.size() / methods.size();
    for (std::size_t m = 0; m < methods.size(); ++m) {
      MethodResults& of_method = sorted.emplace_back();
      of_method.method = methods[m];
      of_method.trials.assign(trials.begin() + m * each, trials.begin() + (m + 1) * each);
      of_method.results.assign(results.begin() + m * each, results.begin() + (m + 1) * each);
    }
    return sorted;
  }

  std::vector<TrialResult> RunAll(const std::vector<Trial>& trials, int threads) {
    benchmark::TrialHooks hooks;
    hooks.stop = Interrupted;
    Progress runs(console_, "run");
    hooks.progress = [&runs](int done, int total) { runs.Report(done, total); };
    auto results = RunTrials(trials, folder_, threads, hooks);
    console_.EndStatus();
    if (!results) throw BenchStopped();
    return std::move(*results);
  }

  const BenchArguments& arguments_;
  const Console& console_;
  baselines::BaselineOptions baselines_;
  FileLock lock_;
  benchmark::ResultFolder folder_;
  // the car park, and the small loops if requested
  std::vector<Place> viewpoints_ = {Places()[0]};
  TableWriter writer_{arguments_, console_};
};

}  // namespace

BenchResults RunBenchTables(const BenchArguments& arguments, const Console& console) {
  return Bench(arguments, console).Run();
}

}  // namespace sslcd::apps
