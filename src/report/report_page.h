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

}  // namespace sslcd
