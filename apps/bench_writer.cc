// SPDX-License-Identifier: BSD-3-Clause
#include "bench_writer.h"

#include <filesystem>
#include <utility>

#include "benchmark/results.h"
#include "formats/atomic_file.h"
#include "formats/file_set.h"
#include "formats/text_rows.h"
#include "sslcd/core/error.h"
#include "sslcd_commit.h"

namespace sslcd::apps {

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
  WriteFileSet(std::move(set));
  console_.Say(ToMarkdown(table));
  tables_.push_back(std::move(table));
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

void TableWriter::CheckDocument() const {
  if (!arguments_.docs.empty()) ReadFileBytes(arguments_.docs);
}

void TableWriter::WriteDocument() const {
  if (arguments_.docs.empty()) return;
  WriteFileAtomically(arguments_.docs, benchmark::ReplaceTables(ReadFileBytes(arguments_.docs),
                                                                arguments_.docs, tables_));
}

}  // namespace sslcd::apps
