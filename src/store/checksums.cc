// SPDX-License-Identifier: BSD-3-Clause
#include "store/checksums.h"

#include <algorithm>

#include "core/sha256.h"
#include "store/schema.h"

namespace sslcd {
namespace {

std::string OneLine(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

}  // namespace

const std::vector<TableKey> kSiteTables = {
    {"site", "id"}, {"label", "name"}, {"cue", "name"}, {"session", "id"}};
const std::vector<TableKey> kResultTables = {{"result", "id"},
                                             {"pose", "frame"},
                                             {"part", "id"},
                                             {"landmark", "id"},
                                             {"sighting", "landmark, position"},
                                             {"appearance", "landmark, cue"},
                                             {"loop", "id"},
                                             {"loop_pair", "loop, position"},
                                             {"edge", "id"}};

std::string TableChecksum(Database& database, const TableKey& table) {
  Sha256 hash;
  Statement rows(database, std::string("SELECT * FROM ") + table.name + " ORDER BY " + table.key);
  while (rows.Step())
    for (int column = 0; column < rows.columns(); ++column) hash.Add(rows.Canonical(column));
  return hash.Finish();
}

void UpdateChecksums(Database& database, const std::vector<TableKey>& tables) {
  Statement update(database, "INSERT OR REPLACE INTO checksum VALUES (?, ?)");
  for (const TableKey& table : tables)
    update.BindText(table.name).BindBlob(TableChecksum(database, table)).Run();
}

std::vector<std::string> ChecksumProblems(Database& database, const std::vector<TableKey>& tables) {
  std::vector<std::string> problems;
  for (const TableKey& table : tables) {
    Statement stored(database, "SELECT sha256 FROM checksum WHERE name = ?");
    stored.BindText(table.name);
    if (!stored.Step())
      problems.push_back(std::string("table ") + table.name + " has no checksum");
    else if (stored.Blob(0) != TableChecksum(database, table))
      problems.push_back(std::string("table ") + table.name +
                         " does not have its checksum: its content was changed");
  }
  return problems;
}

std::vector<std::string> FileProblems(Database& database, bool thorough) {
  std::vector<std::string> problems;
  Statement check(database, thorough ? "PRAGMA integrity_check" : "PRAGMA quick_check");
  while (check.Step())
    if (check.Text(0) != "ok") problems.push_back(OneLine(check.Text(0)));
  if (!problems.empty()) return problems;  // nothing else can be read for sure
  Statement keys(database, "PRAGMA foreign_key_check");
  while (keys.Step())
    problems.push_back("table " + keys.Text(0) + " refers to a row that is not in " + keys.Text(2));
  if (SchemaText(database) != PresentSchemaText())
    problems.push_back("the tables are not those of this schema");
  for (const auto* tables : {&kSiteTables, &kResultTables})
    for (std::string& problem : ChecksumProblems(database, *tables))
      problems.push_back(std::move(problem));
  return problems;
}

}  // namespace sslcd
