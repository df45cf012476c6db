// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/point_matches.h"

#include <gtest/gtest.h>

#include "formats/atomic_file.h"
#include "sslcd/core/error.h"
#include "temp_folder.h"

namespace sslcd::baselines {
namespace {

class PointMatches : public testing::Test {
 protected:
  PlaceMatcher Matcher(const std::string& text) const {
    WriteFileAtomically(file_, text);
    return PointMatchMatcher(file_, {});
  }
  static std::optional<PlaceAnswer> Ask(const PlaceMatcher& matcher, int frame, int old_frame) {
    const std::vector<LayoutObject> none;
    return matcher({none, none, frame, old_frame});
  }
  static std::string Rows(int query, int match, int count, const std::string& confidence) {
    std::string text;
    for (int i = 0; i < count; ++i)
      text += std::to_string(query) + " " + std::to_string(match) + " " + confidence + "\n";
    return text;
  }
  TempFolder temp_;
  const std::string file_ = temp_.path() + "/matches.txt";
};

TEST_F(PointMatches, MeanConfidenceOfTheBestOldFrame) {
  const PlaceMatcher matcher =
      Matcher("# query match confidence\n" + Rows(90, 3, 5, "0.6") + Rows(90, 4, 4, "0.9") +
              Rows(90, 5, 4, "0.7") + Rows(90, 5, 1, "0.9") + Rows(90, 80, 9, "1"));
  const auto answer = Ask(matcher, 90, 40);
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->match_frame, 5) << "four matches are too few, and frame 80 is too young";
  EXPECT_NEAR(answer->score, (4 * 0.7 + 0.9) / 5, 1e-12);
  EXPECT_TRUE(answer->accepted);
  EXPECT_TRUE(answer->matches.empty());
  EXPECT_EQ(Ask(matcher, 90, 4)->match_frame, 3);
  EXPECT_FALSE(Ask(matcher, 90, 2));
  EXPECT_FALSE(Ask(matcher, 91, 40));
}

TEST_F(PointMatches, TooUnsure) {
  const auto answer = Ask(Matcher(Rows(50, 2, 8, "0.3")), 50, 10);
  ASSERT_TRUE(answer);
  EXPECT_FALSE(answer->accepted);
}

TEST_F(PointMatches, BadRows) {
  for (const char* row :
       {"9 3", "9 3 0.5 1", "9 x 0.5", "9 3 1.5", "9 3 nan", "9 -1 0.5", "9 9 0.5", "9.5 3 0.5"}) {
    try {
      Matcher("9 1 0.5\n" + std::string(row) + "\n");
      FAIL() << row;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kBadInput) << row;
      EXPECT_NE(std::string(error.what()).find("matches.txt:2"), std::string::npos) << error.what();
    }
  }
  EXPECT_THROW(PointMatchMatcher(file_ + ".none", {}), Error);
  EXPECT_FALSE(Ask(Matcher(""), 5, 1));
}

}  // namespace
}  // namespace sslcd::baselines
