// SPDX-License-Identifier: BSD-3-Clause
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "commands.h"
#include "core/for_each.h"
#include "examples.h"
#include "formats/atomic_file.h"
#include "formats/json_text.h"
#include "formats/pairs.h"
#include "loop/indexed_match.h"
#include "loop/layout_index.h"
#include "loop/layout_likelihood.h"
#include "loop/paper_match.h"
#include "overwriting.h"
#include "progress.h"
#include "sslcd/config/config.h"
#include "sslcd/loop/layout_match.h"
#include "threads.h"

namespace sslcd::apps {
namespace {

// The keys that `match` reads. It refuses the other keys of a run.
struct MatchConfiguration {
  Mode mode = Mode::kRobust;
  LayoutMatchOptions match;
  PaperMatchOptions paper;
  SingleLookOptions decision;
};

void DescribeFields(FieldVisitor& visitor, MatchConfiguration& configuration) {
  visitor.Enum("mode", configuration.mode, {"robust", "paper"},
               "robust, or the paper's two stages as printed");
  visitor.Section("loop", "the keys that a run has too", [&](FieldVisitor& loop) {
    loop.Nested("match", configuration.match, "layout matching (paper IV-B, IV-C)");
    loop.Nested("paper", configuration.paper, "the matching of mode: paper");
  });
  visitor.Nested("decision", configuration.decision, "when the best pose is accepted");
}

struct MatchArguments {
  std::string pairs, out;
  ConfigArguments config;
  int threads = 1;
  bool json = false;
};

MatchConfiguration Load(const ConfigArguments& arguments) {
  MatchConfiguration all;
  const Describe fields = [&all](FieldVisitor& visitor) { DescribeFields(visitor, all); };
  if (!arguments.file.empty()) LoadConfigFile(arguments.file, fields);
  ApplySettings(arguments.settings, fields);
  if (!arguments.mode.empty()) all.mode = ParseMode(arguments.mode);
  return all;
}

// One row of the output.
struct Answer {
  LoopDecision decision = LoopDecision::kNone;
  YawShift pose;
  double score = 0, second_score = 0;
  std::size_t matches = 0;
  double ms = 0;
  std::size_t looked_at = 0;
  double left_out = -std::numeric_limits<double>::infinity();
};

// What the local maps are matched with: a map of all pairs, whose index is built once, or those of
// the pairs.
struct Target {
  const std::vector<LayoutObject>* map = nullptr;
  std::optional<LayoutIndex> index;
};

Answer MatchRobust(const LayoutPair& pair, const Target& target,
                   const MatchConfiguration& configuration) {
  const LayoutMatchOptions& options = configuration.match;
  const SingleLookOptions& decision = configuration.decision;
  const LayoutAnswer found = target.index
                                 ? MatchLayouts(pair.local, *target.index, options, decision)
                                 : MatchLayouts(pair.local, pair.global, options, decision);
  Answer answer{found.decision, {}, found.score, found.second_score};
  answer.looked_at = found.looked_at;
  answer.left_out = found.left_out;
  if (!found.hypotheses.empty()) {
    answer.pose = found.hypotheses[0].pose;
    answer.matches = found.hypotheses[0].fit.matches.size();
  }
  return answer;
}

// The paper's two stages and a least-squares pose from all matches. It accepts every answer.
Answer MatchPaper(const LayoutPair& pair, const std::vector<LayoutObject>& global,
                  const PaperMatchOptions& options) {
  Answer answer;
  const auto matches = PaperMatch(pair.local, global, options);
  if (!matches) return answer;
  std::vector<Vec3> from, to;
  for (const ObjectMatch& match : *matches) {
    from.push_back(pair.local[match.local].position);
    to.push_back(global[match.global].position);
    answer.score += match.similarity;
  }
  answer.decision = LoopDecision::kAccepted;
  answer.pose = AlignPoints(from, to);
  answer.matches = matches->size();
  return answer;
}

Answer TimedMatch(const LayoutPair& pair, const Target& target,
                  const MatchConfiguration& configuration) {
  const auto start = std::chrono::steady_clock::now();
  Answer answer =
      configuration.mode == Mode::kPaper
          ? MatchPaper(pair, target.map ? *target.map : pair.global, configuration.paper)
          : MatchRobust(pair, target, configuration);
  answer.ms =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  return answer;
}

std::vector<Answer> MatchAll(const std::vector<LayoutPair>& pairs, const Target& target,
                             const MatchConfiguration& configuration, int threads,
                             const Console& console) {
  std::vector<Answer> answers(pairs.size());
  Progress progress(console, "pair");
  ForEach(
      pairs.size(), threads,
      [&](std::size_t i) { answers[i] = TimedMatch(pairs[i], target, configuration); },
      [&](int done, int total) { progress.Report(done, total); });
  console.EndStatus();
  return answers;
}

std::string Csv(const std::vector<LayoutPair>& pairs, const std::vector<Answer>& answers) {
  std::string text =
      "pair,decision,yaw_rad,tx,ty,tz,score,second_score,matches,looked_at,left_out,ms\n";
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Answer& a = answers[i];
    text +=
        std::to_string(pairs[i].id) + "," + ToString(a.decision) + "," + Number("%.6f", a.pose.yaw);
    for (int axis = 0; axis < 3; ++axis) text += "," + Number("%.4f", a.pose.t[axis]);
    text += "," + Number("%.3f", a.score) + "," + Number("%.3f", a.second_score) + "," +
            std::to_string(a.matches) + "," + std::to_string(a.looked_at) + "," +
            (std::isfinite(a.left_out) ? Number("%.3f", a.left_out) : "") + "," +
            Number("%.3f", a.ms) + "\n";
  }
  return text;
}

std::string Json(const std::vector<LayoutPair>& pairs, const std::vector<Answer>& answers) {
  auto list = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Answer& a = answers[i];
    list.push_back({{"pair", pairs[i].id},
                    {"decision", ToString(a.decision)},
                    {"yaw_rad", a.pose.yaw},
                    {"t", {a.pose.t.x(), a.pose.t.y(), a.pose.t.z()}},
                    {"score", a.score},
                    {"second_score", a.second_score},
                    {"matches", a.matches},
                    {"looked_at", a.looked_at},
                    {"left_out", a.left_out},
                    {"ms", a.ms}});
  }
  return JsonText(list, list);
}

int Match(const MatchArguments& a, const Console& console) {
  const MatchConfiguration configuration = Load(a.config);
  RefuseOverwriting({a.pairs, a.config.file}, {a.out});
  const LayoutPairFile file = ReadLayoutPairFile(a.pairs);
  const std::vector<LayoutPair>& pairs = file.pairs;
  Target target;
  if (file.map) {
    target.map = &*file.map;
    if (configuration.mode == Mode::kRobust)
      target.index.emplace(*file.map, configuration.match.max_pair_m, configuration.match.reach_m);
  }
  const std::vector<Answer> answers = MatchAll(pairs, target, configuration, a.threads, console);
  if (!a.out.empty()) WriteFileAtomically(a.out, Csv(pairs, answers));
  if (a.json || a.out.empty()) {
    std::fputs((a.json ? Json(pairs, answers) : Csv(pairs, answers)).c_str(), stdout);
    return 0;
  }
  int count[3] = {0, 0, 0};
  for (const Answer& answer : answers) ++count[static_cast<int>(answer.decision)];
  console.Say(std::to_string(pairs.size()) + " pairs: " + std::to_string(count[2]) + " accepted, " +
              std::to_string(count[1]) + " ambiguous, " + std::to_string(count[0]) + " none");
  console.Say("wrote " + a.out);
  return 0;
}

}  // namespace

Command AddMatchCommand(CLI::App& app, Console& console) {
  CLI::App* command =
      app.add_subcommand("match", "find local maps in global ones, without any prior pose");
  const auto arguments = std::make_shared<MatchArguments>();
  command->add_option("PAIRS", arguments->pairs, "file of map pairs, see docs/formats.md")
      ->required();
  command->add_option("--out", arguments->out, "CSV file to write; default: standard output");
  arguments->config.AddTo(*command);
  AddThreads(*command, arguments->threads);
  command->add_flag("--json", arguments->json, "print the answers as JSON and nothing else");
  command->add_flag("-q,--quiet", console.quiet, "print the answers and errors only");
  command->footer(
      Examples({"match pairs.txt --out answers.csv", "match pairs.txt --mode paper --json"}));
  return [arguments, &console] {
    console.InstallLog();
    return Match(*arguments, console);
  };
}

}  // namespace sslcd::apps
