// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <sstream>

#include "commands.h"
#include "datasets/run_folder.h"
#include "formats/json.h"
#include "formats/number_text.h"
#include "formats/text_rows.h"

namespace sslcd::apps {
namespace {

constexpr int kDigits = 6;

/// Values by name; the names in the order of the first run that has them.
class Comparison {
 public:
  explicit Comparison(std::size_t runs) : runs_(runs) {}

  void Set(const std::string& name, std::size_t run, const std::string& value) {
    auto [at, is_new] = values_.try_emplace(name, runs_, "-");
    if (is_new) names_.push_back(name);
    at->second[run] = value;
  }

  /// Only the rows that differ, if `differing` is set.
  void AddTo(std::vector<std::vector<std::string>>& table, bool differing) const {
    for (const std::string& name : names_) {
      const std::vector<std::string>& values = values_.at(name);
      if (differing && std::set<std::string>(values.begin(), values.end()).size() == 1) continue;
      table.push_back({name});
      table.back().insert(table.back().end(), values.begin(), values.end());
    }
  }

 private:
  std::size_t runs_;
  std::vector<std::string> names_;
  std::map<std::string, std::vector<std::string>> values_;
};

/// Keys such as ba.max_iterations, and values, of a configuration that 'run' has written.
std::vector<std::pair<std::string, std::string>> KeysOf(const std::string& yaml) {
  std::vector<std::pair<std::string, std::string>> keys;
  std::vector<std::pair<std::size_t, std::string>> open;  // indentation and name of what is around
  std::istringstream lines(yaml);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t indent = line.find_first_not_of(' '), colon = line.find(':');
    if (indent == std::string::npos || line[indent] == '#' || colon == std::string::npos) continue;
    while (!open.empty() && open.back().first >= indent) open.pop_back();
    const std::string name = line.substr(indent, colon - indent);
    const std::size_t value = line.find_first_not_of(' ', colon + 1);
    if (value == std::string::npos) {
      open.emplace_back(indent, name);
      continue;
    }
    std::string key;
    for (const auto& [depth, outer] : open) key += outer + ".";
    keys.emplace_back(key + name, line.substr(value));
  }
  return keys;
}

void AddRun(const std::string& folder, std::size_t run, Comparison& results, Comparison& settings) {
  const std::filesystem::path root(folder);
  if (const auto record = CheckRunFolder(folder)) {
    settings.Set("sequence", run, record->dataset);
    settings.Set("commit", run, record->commit);
    for (const auto& [name, value] : record->counts)
      results.Set(name, run, RoundedNumber(value, kDigits));
    results.Set("wall_s", run, FixedNumber(record->wall_s, 1));
    results.Set("cpu_s", run, FixedNumber(record->cpu_s, 1));
    results.Set("warnings", run, std::to_string(record->warnings.size()));
  }
  const JsonValue metrics = ReadJson(root / "metrics.json");
  for (std::size_t i = 0; i < metrics.keys.size(); ++i)
    if (metrics.items[i].kind != JsonValue::Kind::kNull)
      results.Set(metrics.keys[i], run, RoundedNumber(metrics.items[i].Number(), kDigits));
  for (const auto& [key, value] : KeysOf(ReadFileBytes(root / "config.yaml")))
    settings.Set(key, run, value);
}

int Compare(const std::vector<std::string>& runs, const Console& console) {
  Comparison results(runs.size()), settings(runs.size());
  for (std::size_t i = 0; i < runs.size(); ++i) AddRun(runs[i], i, results, settings);
  std::vector<std::string> header = {"run"};
  header.insert(header.end(), runs.begin(), runs.end());
  std::vector<std::vector<std::string>> table = {header};
  results.AddTo(table, false);
  console.Say(AlignedTable(table));
  table = {header};
  settings.AddTo(table, true);
  console.Say(table.size() == 1 ? "\nthe same configuration"
                                : "\nwhat differs\n" + AlignedTable(table));
  return 0;
}

}  // namespace

Command AddCompareCommand(CLI::App& app, Console& console) {
  CLI::App* command = app.add_subcommand(
      "compare", "compare finished runs: results, and what differs in their configuration");
  const auto runs = std::make_shared<std::vector<std::string>>();
  command->add_option("RUN", *runs, "folders written by 'sslcd_run run'")->required();
  command->footer("Example: sslcd_run compare runs/monday runs/tuesday");
  return [runs, &console] {
    console.InstallLog();
    return Compare(*runs, console);
  };
}

}  // namespace sslcd::apps
