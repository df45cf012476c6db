// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "commands.h"
#include "dataset_options.h"
#include "examples.h"
#include "localise.h"
#include "map_files.h"
#include "overwriting.h"
#include "progress.h"
#include "site_ranking.h"
#include "sslcd/core/error.h"
#include "sslcd/core/log.h"

namespace sslcd::apps {
namespace {

constexpr int kNoSite = 5;  // exit code, as of other commands without a solution

struct IndexArguments {
  std::vector<std::string> maps;
  std::string out, add;
};

int Index(const IndexArguments& a, const Console& console) {
  std::vector<std::string> files;
  for (const std::string& path : a.maps)
    for (const std::string& file : MapFiles(path)) files.push_back(file);
  RefuseTwice(files);
  RefuseOverwriting(files, {a.out});
  SiteIndexBuilder builder;
  if (!a.add.empty()) builder.Add(SiteIndex(a.add));
  Progress progress(console, "map");
  int done = 0;
  for (const std::string& file : files) {
    const Site site = ReadMapFile(file);
    if (site.objects.empty())
      Log(LogLevel::kWarning, file + ": has no confirmed landmarks, so it is never found");
    builder.Add(site);
    progress.Report(++done, static_cast<int>(files.size()));
  }
  console.EndStatus();
  builder.Write(a.out);
  const SiteIndex index(a.out, SiteIndexCheck::kHeader);
  console.Say(a.out + ": " + std::to_string(index.size()) + " sites, " +
              std::to_string(index.objects()) + " objects, " +
              Number("%.2f", static_cast<double>(index.file_bytes()) / 1e6) + " MB");
  return 0;
}

struct FindArguments {
  DatasetRequest request;
  std::string sites;
  StretchArguments stretch;
  int first = 10;
  bool verify = false, json = false;
};

enum class Verification { kAccepted, kRefused, kFailed };

// What the localiser says of a site, or why it could not be asked.
struct Verdict {
  Verification result = Verification::kFailed;
  std::string text;
  double score = 0;  // log odds [nats]
};

Verdict Verify(const std::string& map, const Dataset& dataset, const std::vector<Frame>& stretch,
               const Console& console) {
  if (std::filesystem::path(map).extension() == ".json")
    return {Verification::kFailed,
            map + ": nothing can be localised in a map.json; index a map in a file (run --map)"};
  try {
    const std::vector<Attempt> attempts = LocaliseInMap(map, dataset, stretch, true, console);
    if (attempts.empty()) return {Verification::kRefused, "there was no attempt"};
    const Localisation& last = attempts.back().found;
    return {IsFound(attempts.back()) ? Verification::kAccepted : Verification::kRefused,
            last.reason, last.score};
  } catch (const Error& error) {  // no map any more, or one of another kind of data
    return {Verification::kFailed, error.what()};
  }
}

// As long as nobody interrupts.
std::vector<Verdict> VerifyAll(const std::vector<RankedSite>& ranked, const Dataset& dataset,
                               const std::vector<Frame>& stretch, const Console& console) {
  std::vector<Verdict> verdicts;
  for (const RankedSite& site : ranked) {
    Verdict verdict = Verify(site.best.name, dataset, stretch, console);
    if (Interrupted()) break;
    verdicts.push_back(std::move(verdict));
  }
  return verdicts;
}

// Throws if no map could be searched: no answer then, unlike none that is accepted.
void RequireSearch(const std::vector<Verdict>& verdicts) {
  const auto failed = [](const Verdict& one) { return one.result == Verification::kFailed; };
  if (std::all_of(verdicts.begin(), verdicts.end(), failed))
    throw Error(ErrorKind::kBadInput,
                "none of the sites could be verified; the first: " + verdicts.front().text);
}

using Json = nlohmann::ordered_json;

Json JsonOf(const Verdict& verdict) {
  if (verdict.result == Verification::kFailed) return {{"error", verdict.text}};
  return {{"accepted", verdict.result == Verification::kAccepted}, {"reason", verdict.text}};
}

std::string TextOf(const Verdict& verdict) {
  switch (verdict.result) {
    case Verification::kAccepted: return "accepted: " + verdict.text;
    case Verification::kRefused: return "refused: " + verdict.text;
    case Verification::kFailed: break;
  }
  return "not verified: " + verdict.text;
}

void PrintJson(const std::vector<RankedSite>& ranked, const std::vector<Verdict>& verdicts) {
  auto rows = Json::array();
  for (std::size_t i = 0; i < ranked.size(); ++i) {
    const SiteCandidate& best = ranked[i].best;
    Json row = {{"site", best.name},
                {"score", ranked[i].score},
                {"stretches", ranked[i].stretches},
                {"matches", best.matches},
                {"yaw", best.yaw},
                {"x", best.x},
                {"y", best.y}};
    if (i < verdicts.size()) row["verified"] = JsonOf(verdicts[i]);
    rows.push_back(row);
  }
  std::printf("%s\n", rows.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
}

void PrintTable(const std::vector<RankedSite>& ranked, const std::vector<Verdict>& verdicts,
                const Console& console) {
  std::vector<std::vector<std::string>> rows = {
      {"site", "score", "matches", "x", "y", "yaw", "stretches"}};
  if (!verdicts.empty()) rows[0].push_back("localiser");
  for (std::size_t i = 0; i < ranked.size(); ++i) {
    const SiteCandidate& best = ranked[i].best;
    rows.push_back({best.name, Number("%.1f", ranked[i].score), std::to_string(best.matches),
                    Number("%.1f", best.x), Number("%.1f", best.y), Number("%.2f", best.yaw),
                    std::to_string(ranked[i].stretches)});
    if (!verdicts.empty())
      rows.back().push_back(i < verdicts.size() ? TextOf(verdicts[i]) : "not verified");
  }
  console.Say(AlignedTable(rows));
}

// The accepted site of the highest score.
std::optional<std::size_t> Accepted(const std::vector<Verdict>& verdicts) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < verdicts.size(); ++i)
    if (verdicts[i].result == Verification::kAccepted &&
        (!best || verdicts[i].score > verdicts[*best].score))
      best = i;
  return best;
}

int Find(const FindArguments& a, const Console& console) {
  const SiteIndex index(a.sites);
  const Dataset dataset = LoadDataset(a.request);
  for (const std::string& warning : dataset.warnings) Log(LogLevel::kWarning, warning);
  const std::vector<Frame> stretch = StretchOf(dataset, a.stretch);
  const std::vector<RankedSite> ranked = RankSites(index, dataset, stretch, a.first);
  std::vector<Verdict> verdicts;
  if (a.verify) verdicts = VerifyAll(ranked, dataset, stretch, console);
  if (a.json) PrintJson(ranked, verdicts);
  if (ranked.empty()) {
    console.Say("no site has objects as in this drive");
    return kNoSite;
  }
  PrintTable(ranked, verdicts, console);
  if (!a.verify) return 0;
  if (Interrupted()) return InterruptCode();
  RequireSearch(verdicts);
  const std::optional<std::size_t> accepted = Accepted(verdicts);
  console.Say(accepted ? "the drive is from " + ranked[*accepted].best.name
                       : "the localiser accepts none of them");
  return accepted ? 0 : kNoSite;
}

void AddIndex(CLI::App& sites, IndexArguments& a, Console& console) {
  CLI::App* command = sites.add_subcommand("index", "write an index of maps");
  command
      ->add_option("MAP", a.maps,
                   "maps in files, map.json files, run folders, or folders with any of these")
      ->required();
  command->add_option("--out", a.out, "file to write")->required();
  command->add_option("--add", a.add, "an index whose sites come first: extends it");
  command->add_flag("-q,--quiet", console.quiet, "print errors only");
  command->footer(Examples(
      {"sites index maps/ --out all.sites", "sites index new.db --add all.sites --out all.sites"}));
}

void AddFind(CLI::App& sites, FindArguments& a, Console& console) {
  CLI::App* command = sites.add_subcommand("find", "rank the sites that a drive may be from");
  command->add_option("DATASET", a.request.path, "dataset folder")->required();
  command->add_option("--sites", a.sites, "file of the index")->required();
  AddTo(*command, a.request);
  AddTo(*command, a.stretch);
  command->add_option("--first", a.first, "number of sites to rank")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_flag("--verify", a.verify,
                    "localise in the map of each of them; the answer is the one that is accepted");
  command->add_flag("--json", a.json, "print JSON and nothing else");
  command->add_flag("-q,--quiet", console.quiet, "print errors only");
  command->footer(Examples({"sites find my_sequence --sites all.sites",
                            "sites find my_sequence --sites all.sites --from 20 --frames 150 "
                            "--first 5 --verify"}));
}

}  // namespace

Command AddSitesCommand(CLI::App& app, Console& console) {
  CLI::App* command =
      app.add_subcommand("sites", "index many maps; which of them is a drive from?");
  command->require_subcommand(1);
  command->footer(Examples({"sites index monday.db tuesday.db --out all.sites",
                            "sites find my_sequence --sites all.sites --verify"}));
  const auto index = std::make_shared<IndexArguments>();
  const auto find = std::make_shared<FindArguments>();
  AddIndex(*command, *index, console);
  AddFind(*command, *find, console);
  return [command, index, find, &console] {
    if (find->json) console.quiet = true;
    console.InstallLog();
    return command->get_subcommands().front()->get_name() == "index" ? Index(*index, console)
                                                                     : Find(*find, console);
  };
}

}  // namespace sslcd::apps
