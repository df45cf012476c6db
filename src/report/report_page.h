// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace sslcd {

/// Throws Error(kBadConfig), with what to install, if three.js and Chart.js were not found when the
/// program was configured.
void RequireReportLibraries();

/// Returns a page that shows the data of ReportJson without any other file. Throws as
/// RequireReportLibraries() does.
std::string ReportPage(const std::string& data, const std::string& title);

/// Returns a page of the tables and curves of a benchmark, without any other file. `data` is JSON
/// without '<': lists `tables` and `curves` of objects with `key`, `title`, `header`, `rows` and
/// `note`. Throws as RequireReportLibraries() does.
std::string BenchPage(const std::string& data, const std::string& title);

}  // namespace sslcd
