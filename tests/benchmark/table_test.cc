// SPDX-License-Identifier: BSD-3-Clause
#include "benchmark/table.h"

#include <gtest/gtest.h>

#include "sslcd/core/error.h"

namespace sslcd::benchmark {
namespace {

const Table kTable{
    "t", "A title", {"name", "value"}, {{"plain", "1.50"}, {"with, \"quotes\"", ""}}, "A note."};

TEST(Table, Markdown) {
  EXPECT_EQ(ToMarkdown(kTable),
            "**A title**\n\n| name | value |\n| --- | --- |\n| plain | 1.50 |\n| with, \"quotes\" "
            "| - |\n\nA note.\n");
}

TEST(Table, Csv) {
  EXPECT_EQ(ToCsv(kTable), "name,value\nplain,1.50\n\"with, \"\"quotes\"\"\",\n");
}

TEST(Table, Json) {
  EXPECT_EQ(ToJson(kTable),
            "[\n {\n  \"name\": \"plain\",\n  \"value\": 1.5\n },\n"
            " {\n  \"name\": \"with, \\\"quotes\\\"\",\n  \"value\": null\n }\n]\n");
}

TEST(Table, ReplacedInADocument) {
  const std::string before = "Text.\n<!-- bench t -->\nold\nold\n<!-- /bench -->\nMore.\n";
  const std::string after = ReplaceTables(before, "doc.md", {kTable});
  EXPECT_EQ(after, "Text.\n<!-- bench t -->\n" + ToMarkdown(kTable) + "<!-- /bench -->\nMore.\n");
  EXPECT_EQ(ReplaceTables(after, "doc.md", {kTable}), after) << "and again";
}

TEST(Table, NoPlaceInTheDocument) {
  for (const char* text :
       {"", "<!-- bench other -->\n<!-- /bench -->\n", "<!-- bench t -->\nnever ends\n"}) {
    try {
      ReplaceTables(text, "doc.md", {kTable});
      FAIL() << text;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("doc.md: has no place for t"), std::string::npos)
          << error.what();
    }
  }
}

}  // namespace
}  // namespace sslcd::benchmark
