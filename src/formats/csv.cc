// SPDX-License-Identifier: BSD-3-Clause
#include "formats/csv.h"

#include "formats/text_rows.h"
#include "sslcd/core/error.h"

namespace sslcd {

std::string CsvField(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + "\"";
}

std::vector<CsvRow> ReadCsv(const std::string& path) {
  const std::string text = ReadFileBytes(path);
  std::vector<CsvRow> rows;
  std::string field;
  bool quoted = false, in_row = false;
  int line = 1;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    line += c == '\n';
    if (!in_row && (c == '\n' || c == '\r')) continue;
    if (!in_row) rows.push_back({line, {}});
    in_row = true;
    if (quoted && c == '"' && i + 1 < text.size() && text[i + 1] == '"') {
      field += text[++i];
    } else if (c == '"') {
      quoted = !quoted;
    } else if (!quoted && (c == ',' || c == '\n')) {
      rows.back().fields.push_back(std::move(field));
      field.clear();
      in_row = c == ',';
    } else if (quoted || c != '\r') {
      field += c;
    }
  }
  if (quoted) throw Error(ErrorKind::kBadInput, {path, rows.back().line}, "ends inside of quotes");
  if (in_row) rows.back().fields.push_back(std::move(field));
  return rows;
}

}  // namespace sslcd
