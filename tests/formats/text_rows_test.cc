// SPDX-License-Identifier: BSD-3-Clause
#include "formats/text_rows.h"

#include <cmath>

#include "temp_folder.h"

namespace sslcd {
namespace {

TEST(TextRows, SkipsBlankLinesAndCommentsAndCountsLines) {
  const TempFolder folder;
  TextRows rows(
      folder.Write("a.txt", "\xEF\xBB\xBF# head\r\n\r\n 1\t+2.5  -3e1 \r\n\n4,5 , 6,\nlast"));
  ASSERT_TRUE(rows.Next());
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_FALSE(rows.has_commas());
  EXPECT_EQ(rows.where().line, 3);
  EXPECT_EQ(rows.Number(0), 1);
  EXPECT_EQ(rows.Number(1), 2.5);
  EXPECT_EQ(rows.Number(2), -30);
  ASSERT_TRUE(rows.Next());
  ASSERT_EQ(rows.size(), 3u) << "one comma at the end is no field";
  EXPECT_TRUE(rows.has_commas());
  EXPECT_EQ(rows.Integer(1), 5);
  ASSERT_TRUE(rows.Next());
  EXPECT_EQ(rows.Text(0), "last");
  EXPECT_EQ(rows.where().line, 6);
  EXPECT_FALSE(rows.Next());
  EXPECT_FALSE(rows.Next());
}

TEST(TextRows, RefusesWhatIsNoNumber) {
  const TempFolder folder;
  TextRows rows(folder.Write("a.txt", "\n12x 1.5 1e999 99999999999\n1,,2\n"));
  ASSERT_TRUE(rows.Next());
  ExpectError([&] { rows.Number(0); }, {"a.txt:2: column 1", "'12x'"});
  ExpectError([&] { rows.Integer(1); }, {"a.txt:2: column 2", "whole number", "'1.5'"});
  ExpectError([&] { rows.Number(2); }, {"'1e999'"});
  ExpectError([&] { rows.Integer(3); }, {"'99999999999'"});
  ASSERT_TRUE(rows.Next());
  ASSERT_EQ(rows.size(), 3u);
  ExpectError([&] { rows.Number(1); }, {"a.txt:3: column 2", "''"});
}

TEST(TextRows, NumbersKnowNoLocaleAndNoRest) {
  EXPECT_EQ(ParseNumber("-0.25"), -0.25);
  EXPECT_TRUE(std::isnan(ParseNumber("nan").value()));
  EXPECT_TRUE(std::isinf(ParseNumber("-inf").value()));
  for (const char* text : {"", "+", "+-1", "1,5", "1 ", " 1", "1.5.2", "0x10", "1e", "--1"}) {
    EXPECT_FALSE(ParseNumber(text).has_value()) << text;
  }
}

TEST(TextRows, SaysWhyAFileCannotBeRead) {
  const TempFolder folder;
  ExpectError([&] { TextRows rows(folder.path() + "/none.txt"); },
              {"none.txt: cannot be read", "No such file"});
  ExpectError([&] { TextRows rows(folder.path()); }, {"is a folder"});
  ExpectError([] { TextRows rows("/dev/zero"); }, {"/dev/zero: is a device"});
  TextRows empty(folder.Write("empty.txt", ""));
  EXPECT_FALSE(empty.Next());
}

}  // namespace
}  // namespace sslcd
