// SPDX-License-Identifier: BSD-3-Clause
#include "benchmark/table.h"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "formats/csv.h"
#include "formats/text_rows.h"
#include "sslcd/core/error.h"

namespace sslcd::benchmark {
namespace {

std::string MarkdownRow(const std::vector<std::string>& cells) {
  std::string row = "|";
  for (const std::string& cell : cells) row += " " + (cell.empty() ? "-" : cell) + " |";
  return row + "\n";
}

std::string CsvRow(const std::vector<std::string>& cells) {
  std::string row;
  for (std::size_t i = 0; i < cells.size(); ++i) row += (i > 0 ? "," : "") + CsvField(cells[i]);
  return row + "\n";
}

}  // namespace

std::string ToMarkdown(const Table& table) {
  std::string text = "**" + table.title + "**\n\n" + MarkdownRow(table.header) +
                     MarkdownRow(std::vector<std::string>(table.header.size(), "---"));
  for (const auto& row : table.rows) text += MarkdownRow(row);
  if (!table.note.empty()) text += "\n" + table.note + "\n";
  return text;
}

std::string ToCsv(const Table& table) {
  std::string text = CsvRow(table.header);
  for (const auto& row : table.rows) text += CsvRow(row);
  return text;
}

std::string ToJson(const Table& table) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const auto& row : table.rows) {
    nlohmann::ordered_json object;
    for (std::size_t i = 0; i < row.size(); ++i) {
      nlohmann::ordered_json& value = object[table.header[i]];
      if (row[i].empty()) continue;  // null
      if (const auto number = ParseNumber(row[i]))
        value = *number;
      else
        value = row[i];
    }
    list.push_back(object);
  }
  return list.dump(1) + "\n";
}

std::string ReplaceTables(std::string document, const std::string& name,
                          const std::vector<Table>& tables) {
  for (const Table& table : tables) {
    const std::string begin = "<!-- bench " + table.key + " -->\n", end = "<!-- /bench -->";
    const std::size_t from = document.find(begin);
    const std::size_t to = from == std::string::npos ? from : document.find(end, from);
    if (to == std::string::npos)
      throw Error(ErrorKind::kBadInput, {name},
                  "has no place for " + table.key + ": it goes between the lines '" +
                      begin.substr(0, begin.size() - 1) + "' and '" + end + "'");
    document.replace(from + begin.size(), to - from - begin.size(), ToMarkdown(table));
  }
  return document;
}

std::string Cell(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

}  // namespace sslcd::benchmark
