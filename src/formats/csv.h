// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace sslcd {

/// Returns a field of a CSV file (RFC 4180), quoted if it contains a comma, a quote or a line
/// break.
std::string CsvField(const std::string& text);

/// A row of a CSV file and the line where it starts.
struct CsvRow {
  int line = 0;
  std::vector<std::string> fields;
};

/// Reads all rows of a CSV file (RFC 4180), the header included. Throws Error(kBadInput) if the
/// file cannot be read or ends inside of quotes.
std::vector<CsvRow> ReadCsv(const std::string& path);

}  // namespace sslcd
