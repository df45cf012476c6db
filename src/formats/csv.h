// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace sslcd {

/// A field of a CSV file (RFC 4180): in quotes where it holds a comma, a quote or a line break.
std::string CsvField(const std::string& text);

}  // namespace sslcd
