// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace sslcd::benchmark {

/// Cells as they are to be read; empty: nothing was measured.
struct Table {
  std::string key;    ///< file name
  std::string title;  ///< one line
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
  std::string note{};  ///< what stands below it
};

std::string ToMarkdown(const Table& table);
std::string ToCsv(const Table& table);  ///< RFC 4180: quotes where needed
/// A list of objects, header -> cell; a cell that is a number becomes one, an empty one null.
std::string ToJson(const Table& table);

/// Puts the tables' Markdown between the lines `<!-- bench KEY -->` and `<!-- /bench -->` of a
/// document. Throws Error(kBadInput) if a pair of lines is not there.
std::string ReplaceTables(std::string document, const std::string& name,
                          const std::vector<Table>& tables);

/// printf-style number.
std::string Cell(const char* format, double value);

}  // namespace sslcd::benchmark
