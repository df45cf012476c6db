// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "check/checks.h"
#include "formats/run_json.h"

namespace sslcd::check {

/// A line for each test, and for each mistake its evidence and the fix to try.
std::string ReportText(const CheckReport& report);

/// The same for run.json, one for each test.
std::vector<CheckRecord> Records(const CheckReport& report);

/// {"mistakes": count, "checks": [{"check", "result", "text", "mistake", "fix"}]}; "mistake" and
/// "fix" only of a mistake.
std::string ReportJson(const CheckReport& report);

/// Checks() as a Markdown table (docs/check.md).
std::string MistakesMarkdown();

}  // namespace sslcd::check
