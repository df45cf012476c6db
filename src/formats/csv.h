// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace sslcd {

/// Returns a field of a CSV file (RFC 4180), quoted if it contains a comma, a quote or a line
/// break.
std::string CsvField(const std::string& text);

}  // namespace sslcd
