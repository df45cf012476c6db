// SPDX-License-Identifier: BSD-3-Clause
#include "report/report_page.h"

#include "report/assets.h"
#include "report/markup.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

void Replace(std::string& text, const std::string& mark, const std::string& by) {
  for (std::size_t at = text.find(mark); at != std::string::npos;
       at = text.find(mark, at + by.size()))
    text.replace(at, mark.size(), by);
}

// A script of a library must not end the element that holds it.
std::string Script(std::string text) {
  for (std::size_t at = text.find("</script"); at != std::string::npos;
       at = text.find("</script", at))
    text.replace(at, 2, "<\\/");
  return "<script>\n" + text + "\n</script>\n";
}

std::string Page(std::string_view form, const std::string& libraries, const std::string& own,
                 const std::string& data, const std::string& title) {
  std::string page(form);
  Replace(page, "<!-- title -->", MarkupText(title));
  Replace(page, "/* style */", std::string(ReportStyle()));
  Replace(page, "<!-- licences -->", MarkupText(std::string(ReportLicences())));
  Replace(page, "<!-- scripts -->",
          libraries + Script("(() => {\n\"use strict\";\n" + own + "})();"));
  Replace(page, "<!-- data -->", data);
  return page;
}

}  // namespace

void RequireReportLibraries() {
  for (const Asset& asset : ReportLibraries()) {
    if (!asset.text.empty()) continue;
    throw Error(
        ErrorKind::kBadConfig,
        "this program was built without three.js and Chart.js, which a report shows runs "
        "with: install libjs-three and libjs-chart.js (scripts/install_deps.sh build), then "
        "configure and build it again; 'sslcd_run draw' makes a picture without them");
  }
}

std::string ReportPage(const std::string& data, const std::string& title) {
  RequireReportLibraries();
  std::string libraries, own;
  for (const Asset& asset : ReportLibraries()) libraries += Script(std::string(asset.text));
  for (const Asset& asset : ReportScripts()) own += std::string(asset.text) + "\n";
  return Page(ReportTemplate(), libraries, own, data, title);
}

std::string BenchPage(const std::string& data, const std::string& title) {
  RequireReportLibraries();
  std::string own;
  for (const Asset& asset : ReportScripts())
    if (asset.name == "page.js" || asset.name == "charts.js") own += std::string(asset.text) + "\n";
  return Page(BenchTemplate(), Script(std::string(ReportLibraries().back().text)),
              own + std::string(BenchScript()), data, title);
}

}  // namespace sslcd
