// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace sslcd::benchmark {

/// A table of formatted cells. An empty cell has no measurement.
struct Table {
  std::string key;    ///< file name
  std::string title;  ///< one line
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
  std::string note{};  ///< text below the table
};

std::string ToMarkdown(const Table& table);
std::string ToCsv(const Table& table);  ///< RFC 4180
/// A list of objects with the cells by header. Numeric cells become numbers, empty cells null.
std::string ToJson(const Table& table);

/// Writes the tables as Markdown between the lines `<!-- bench KEY -->` and `<!-- /bench -->` of a
/// document. Throws Error(kBadInput) if such a pair of lines is missing.
std::string ReplaceTables(std::string document, const std::string& name,
                          const std::vector<Table>& tables);

/// Formats a number like printf.
std::string Cell(const char* format, double value);

}  // namespace sslcd::benchmark
