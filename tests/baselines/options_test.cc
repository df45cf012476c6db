// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "sslcd/config/config.h"
#include "sslcd/core/error.h"

namespace sslcd::baselines {
namespace {

Describe Of(BaselineOptions& options) {
  return [&options](FieldVisitor& visitor) { DescribeFields(visitor, options); };
}

TEST(BaselineOptions, TheFileHoldsTheDefaults) {
  const auto path = std::filesystem::path(__FILE__).parent_path() / "../../config/baselines.yaml";
  std::ifstream file(path);
  std::string first_line, text;
  std::getline(file, first_line);
  std::stringstream rest;
  rest << file.rdbuf();
  BaselineOptions defaults, loaded;
  EXPECT_EQ(rest.str(), DumpConfig(Of(defaults), true));
  LoadConfigFile(path.string(), Of(loaded));
  EXPECT_EQ(DumpConfig(Of(loaded), false), DumpConfig(Of(defaults), false));
}

TEST(BaselineOptions, LoadsStrictly) {
  BaselineOptions options;
  LoadConfigText("lin:\n  walks:\n    steps: 5\nx_view:\n  seed: 9\n", "t.yaml", Of(options));
  EXPECT_EQ(options.lin.walks.steps, 5);
  EXPECT_EQ(options.x_view.seed, 9);
  try {
    LoadConfigText("lin:\n  candidate: 3\nsemantic_histogram:\n  path_length: 1\n", "t.yaml",
                   Of(options));
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("t.yaml:2:3: unknown key 'candidate'"));
    EXPECT_THAT(error.what(), testing::HasSubstr("t.yaml:4:"));
  }
}

}  // namespace
}  // namespace sslcd::baselines
