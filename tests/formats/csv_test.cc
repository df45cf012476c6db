// SPDX-License-Identifier: BSD-3-Clause
#include "formats/csv.h"

#include <gtest/gtest.h>

namespace sslcd {
namespace {

TEST(CsvField, IsQuotedOnlyWhereItMustBe) {
  EXPECT_EQ(CsvField(""), "");
  EXPECT_EQ(CsvField("9 objects agree"), "9 objects agree");
  EXPECT_EQ(CsvField("near, but not here"), "\"near, but not here\"");
  EXPECT_EQ(CsvField("a \"b\""), "\"a \"\"b\"\"\"");
  EXPECT_EQ(CsvField("two\nlines"), "\"two\nlines\"");
  EXPECT_EQ(CsvField("\r"), "\"\r\"");
}

}  // namespace
}  // namespace sslcd
