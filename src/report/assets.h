// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>
#include <vector>

namespace sslcd {

/// A file that was embedded when the program was built.
struct Asset {
  std::string_view name, text;
};

/// three.js, its OrbitControls, Chart.js; empty texts: not found at configure time.
std::vector<Asset> ReportLibraries();
/// The modules of src/report/web in the order of the page.
std::vector<Asset> ReportScripts();
std::string_view ReportTemplate();
std::string_view ReportStyle();
std::string_view ReportLicences();
/// Of the page of a benchmark, which shares page.js and charts.js.
std::string_view BenchTemplate();
std::string_view BenchScript();

}  // namespace sslcd
