// SPDX-License-Identifier: BSD-3-Clause
#include "formats/metrics_json.h"

#include <nlohmann/json.hpp>

#include "formats/json_text.h"

namespace sslcd {

using Json = nlohmann::ordered_json;

std::string TimingJson(const TimingTable& timing) {
  Json root = Json::object();
  for (const auto& [stage, times] : timing.Summary()) {
    Json& row = root[stage];
    row["count"] = times.count;
    row["mean_ms"] = times.mean;
    row["p50_ms"] = times.p50;
    row["p95_ms"] = times.p95;
    row["max_ms"] = times.max;
  }
  return JsonText(root, root);
}

std::string MetricsJson(const Metrics& metrics) {
  Json root = Json::object();
  for (const auto& [name, value] : metrics) root[name] = value ? Json(*value) : Json();
  return JsonText(root, root);
}

}  // namespace sslcd
