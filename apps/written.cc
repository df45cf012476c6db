// SPDX-License-Identifier: BSD-3-Clause
#include "written.h"

#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "formats/json_text.h"

namespace sslcd::apps {

void PrintWritten(nlohmann::ordered_json facts, const std::vector<std::string>& paths) {
  auto written = nlohmann::ordered_json::array();
  for (const std::string& path : paths)
    written.push_back({{"path", path}, {"bytes", std::filesystem::file_size(path)}});
  facts["written"] = std::move(written);
  std::fputs(JsonText(facts, facts["written"]).c_str(), stdout);
}

}  // namespace sslcd::apps
