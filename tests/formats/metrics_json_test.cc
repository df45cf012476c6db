// SPDX-License-Identifier: BSD-3-Clause
#include "formats/metrics_json.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sslcd {
namespace {

TEST(TimingJson, StagesOfAnyName) {
  TimingTable timing;
  timing.Add("a \"stage\"\n", 1.5);
  timing.Add("other", 2);
  EXPECT_EQ(TimingJson(timing),
            "{\n\"a \\\"stage\\\"\\n\":{\"count\":1,\"mean_ms\":1.5,\"p50_ms\":1.5,\"p95_ms\":1.5,"
            "\"max_ms\":1.5},\n\"other\":{\"count\":1,\"mean_ms\":2,\"p50_ms\":2,\"p95_ms\":2,"
            "\"max_ms\":2}\n}\n");
  EXPECT_EQ(TimingJson({}), "{\n}\n");
}

TEST(MetricsJson, ValuesThatDoNotExistAreNull) {
  EXPECT_EQ(MetricsJson({{"ate_m", 1.25}, {"iou", std::nullopt}, {"nan", std::nan("")}}),
            "{\n\"ate_m\":1.25,\n\"iou\":null,\n\"nan\":null\n}\n");
  EXPECT_EQ(MetricsJson({}), "{\n}\n");
}

}  // namespace
}  // namespace sslcd
