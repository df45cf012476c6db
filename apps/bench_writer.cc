// SPDX-License-Identifier: BSD-3-Clause
#include "bench_writer.h"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "benchmark/results.h"
#include "formats/atomic_file.h"
#include "formats/file_set.h"
#include "formats/json_text.h"
#include "formats/text_rows.h"
#include "overwriting.h"
#include "report/report_page.h"
#include "sslcd/core/error.h"
#include "sslcd_commit.h"

namespace sslcd::apps {
namespace {

// The data of src/report/web/bench.js. '<' is escaped: the text stands in a page.
std::string BenchJson(const BenchResults& results) {
  nlohmann::ordered_json root;
  const auto add = [&root](const char* name, const std::vector<benchmark::Table>& tables) {
    root[name] = nlohmann::ordered_json::array();
    for (const benchmark::Table& table : tables)
      root[name].push_back({{"key", table.key},
                            {"title", table.title},
                            {"header", table.header},
                            {"rows", table.rows},
                            {"note", table.note}});
  };
  add("tables", results.tables);
  add("curves", results.curves);
  std::string text;
  for (const char c : JsonText(root, root["tables"]))
    text += c == '<' ? "\\u003c" : std::string(1, c);
  return text;
}

}  // namespace

void TableWriter::Write(benchmark::Table table, const std::vector<int>& cases,
                        const std::vector<benchmark::Table>& curves) {
  table.note = Provenance(cases);
  const std::string path = arguments_.out + "/";
  FileSet set{arguments_.out,
              table.key,
              {{path + table.key + ".md", ToMarkdown(table)},
               {path + table.key + ".json", ToJson(table)},
               {path + table.key + ".csv", ToCsv(table)}},
              {}};
  for (const benchmark::Table& curve : curves)
    set.files.emplace_back(path + curve.key + ".csv", ToCsv(curve));
  for (const auto& file : set.files) results_.paths.push_back(file.first);
  WriteFileSet(std::move(set));
  console_.Say(ToMarkdown(table));
  results_.tables.push_back(std::move(table));
  results_.curves.insert(results_.curves.end(), curves.begin(), curves.end());
}

std::string TableWriter::Provenance(const std::vector<int>& cases) const {
  std::string note = "Commit " + std::string(SSLCD_COMMIT);
  if (!cases.empty()) note += ", seeds 1 to " + std::to_string(arguments_.seeds) + ", cases ";
  for (const int c : cases) note += (c == cases[0] ? "" : ", ") + std::to_string(c);
  note += ": `sslcd_run bench " + arguments_.name;
  const auto add = [&](const char* option, const std::string& value) {
    if (!value.empty())
      note += std::string(" --") + option + " " + std::filesystem::path(value).filename().string();
  };
  if (cases.empty()) add("kitti", arguments_.kitti);
  if (!arguments_.methods.empty()) note += " --methods ...";
  if (arguments_.Asks("viewpoint") && arguments_.viewpoints != benchmark::ViewpointRanges())
    note += " --viewpoints ...";
  add("images", arguments_.images);
  add("matches", arguments_.matches);
  add("baselines", arguments_.baselines);
  return note + "`.";
}

void TableWriter::CheckPlaces() const {
  if (!arguments_.docs.empty()) ReadFileBytes(arguments_.docs);
  if (arguments_.report.empty()) return;
  RequireReportLibraries();
  RequirePlaceOf(arguments_.report);
  RefuseOverwriting({arguments_.layout, arguments_.baselines, arguments_.docs}, {arguments_.report},
                    "--report");
}

BenchResults TableWriter::Finish() {
  const std::string &document = arguments_.docs, &page = arguments_.report;
  if (!document.empty()) {
    WriteFileAtomically(
        document, benchmark::ReplaceTables(ReadFileBytes(document), document, results_.tables));
    results_.paths.push_back(document);
  }
  if (!page.empty()) {
    WriteFileAtomically(page, BenchPage(BenchJson(results_), "bench " + arguments_.name));
    results_.paths.push_back(page);
  }
  return std::move(results_);
}

}  // namespace sslcd::apps
