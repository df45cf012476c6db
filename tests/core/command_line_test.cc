// SPDX-License-Identifier: BSD-3-Clause
#include "core/command_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sslcd {
namespace {

TEST(CommandLine, ItIsThatOfThisProgram) {
  ASSERT_FALSE(CommandWords().empty());
  EXPECT_THAT(CommandWords().front(), testing::HasSubstr("sslcd_core_tests"));
}

TEST(CommandLine, WordsWithBlanksAreInQuotes) {
  EXPECT_EQ(CommandLine({"run", "my data", "", "$x", "--out=a"}), "run 'my data' '' '$x' --out=a");
  EXPECT_EQ(CommandLine({}), "");
}

}  // namespace
}  // namespace sslcd
