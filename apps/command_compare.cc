// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>

#include "commands.h"
#include "datasets/run_folder.h"
#include "examples.h"
#include "formats/json.h"
#include "formats/json_text.h"
#include "formats/number_text.h"
#include "formats/text_rows.h"

namespace sslcd::apps {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kDigits = 6;

/// A number, a text, or null as a cell of a table.
std::string Cell(const Json& value) {
  if (value.is_null()) return "-";
  return value.is_string() ? value.get<std::string>() : RoundedNumber(value.get<double>(), kDigits);
}

/// Values by name; the names in the order of the first run that has them.
class Comparison {
 public:
  explicit Comparison(std::size_t runs) : runs_(runs) {}

  void Set(const std::string& name, std::size_t run, Json value) {
    auto [at, is_new] = values_.try_emplace(name, runs_);
    if (is_new) names_.push_back(name);
    at->second[run] = std::move(value);
  }

  /// Only the rows that differ.
  Comparison Differing() const {
    Comparison rows = *this;
    const auto same = [&](const std::string& name) {
      const std::vector<Json>& values = values_.at(name);
      return std::all_of(values.begin(), values.end(),
                         [&](const Json& value) { return value == values[0]; });
    };
    rows.names_.erase(std::remove_if(rows.names_.begin(), rows.names_.end(), same),
                      rows.names_.end());
    return rows;
  }

  bool empty() const { return names_.empty(); }

  std::string Table(std::vector<std::string> header) const {
    std::vector<std::vector<std::string>> table = {std::move(header)};
    for (const std::string& name : names_) {
      table.push_back({name});
      for (const Json& value : values_.at(name)) table.back().push_back(Cell(value));
    }
    return AlignedTable(table);
  }

  /// An object with a list of values for each name.
  Json ToJson() const {
    Json rows = Json::object();
    for (const std::string& name : names_) rows[name] = values_.at(name);
    return rows;
  }

 private:
  std::size_t runs_;
  std::vector<std::string> names_;
  std::map<std::string, std::vector<Json>> values_;
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
    for (const auto& [name, value] : record->counts) results.Set(name, run, value);
    results.Set("wall_s", run, record->wall_s);
    results.Set("cpu_s", run, record->cpu_s);
    results.Set("warnings", run, record->warnings.size());
  }
  const JsonValue metrics = ReadJson(root / "metrics.json");
  for (std::size_t i = 0; i < metrics.keys.size(); ++i)
    if (metrics.items[i].kind != JsonValue::Kind::kNull)
      results.Set(metrics.keys[i], run, metrics.items[i].Number());
  for (const auto& [key, value] : KeysOf(ReadFileBytes(root / "config.yaml")))
    settings.Set(key, run, value);
}

int Compare(const std::vector<std::string>& runs, bool json, const Console& console) {
  Comparison results(runs.size()), settings(runs.size());
  for (std::size_t i = 0; i < runs.size(); ++i) AddRun(runs[i], i, results, settings);
  const Comparison differing = settings.Differing();
  if (json) {
    const Json root = {
        {"runs", runs}, {"results", results.ToJson()}, {"differences", differing.ToJson()}};
    std::fputs(JsonText(root, root).c_str(), stdout);
    return 0;
  }
  std::vector<std::string> header = {"run"};
  header.insert(header.end(), runs.begin(), runs.end());
  console.Say(results.Table(header));
  console.Say(differing.empty() ? "\nthe same configuration"
                                : "\nwhat differs\n" + differing.Table(header));
  return 0;
}

}  // namespace

Command AddCompareCommand(CLI::App& app, Console& console) {
  CLI::App* command = app.add_subcommand(
      "compare", "compare finished runs: results, and what differs in their configuration");
  const auto runs = std::make_shared<std::vector<std::string>>();
  command->add_option("RUN", *runs, "folders written by 'sslcd_run run'")->required();
  const auto json = std::make_shared<bool>(false);
  command->add_flag("--json", *json, "print JSON");
  command->footer(
      Examples({"compare runs/monday runs/tuesday", "compare runs/monday runs/tuesday --json"}));
  return [runs, json, &console] {
    console.InstallLog();
    return Compare(*runs, *json, console);
  };
}

}  // namespace sslcd::apps
