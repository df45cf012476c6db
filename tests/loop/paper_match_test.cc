// SPDX-License-Identifier: BSD-3-Clause
#include "loop/paper_match.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "loop/layout.h"
#include "loop/semantics.h"

namespace sslcd {
namespace {

LayoutObject Object(const Vec3& position, int label = 0) {
  LayoutObject object;
  object.position = position;
  object.label = label;
  object.dims = Vec3(4, 2, 1.5);
  return object;
}

/// A street whose gaps are all different, so that every layout vector is.
std::vector<LayoutObject> Street(const Vec3& shift = Vec3(0, 0, 0)) {
  std::vector<LayoutObject> objects;
  double x = 0;
  for (int i = 0; i < 12; ++i) {
    objects.push_back(Object(shift + Vec3(x, i % 2 ? 6. : 0., 0)));
    x += 3 + 1.7 * (i * i % 7);
  }
  return objects;
}

TEST(PaperMatch, WithoutDriftEveryObjectFindsItself) {
  const auto matches = PaperMatch(Street(), Street(), PaperMatchOptions());
  ASSERT_TRUE(matches);
  ASSERT_EQ(matches->size(), 12u);
  for (int i = 0; i < 12; ++i) {
    const ObjectMatch& match = (*matches)[i];
    EXPECT_EQ(match.local, i);
    EXPECT_EQ(match.global, i);
    EXPECT_EQ(match.layout_difference, 0);
    EXPECT_EQ(match.similarity, 2);
  }
}

TEST(PaperMatch, KeepsToItsThresholdsAndTakesTheMostSimilar) {
  const std::vector<LayoutObject> local = Street(), global = Street(Vec3(0.4, 0.1, 0));
  PaperMatchOptions options;
  options.neighbours = 3;
  options.layout_difference = 0.1;
  options.similarity = 1.1;
  const auto matches = PaperMatch(local, global, options);
  ASSERT_TRUE(matches);
  ObjectGraph local_graph, global_graph;
  for (int i = 0; i < 12; ++i) {
    local_graph.Put(i, local[i].position);
    global_graph.Put(i, global[i].position);
  }
  std::size_t next = 0;
  for (int i = 0; i < 12; ++i) {
    int best = -1;
    double highest = 0;
    for (int j = 0; j < 12; ++j) {
      if (LayoutDifference(*LayoutVector(local_graph, i, 3), *LayoutVector(global_graph, j, 3)) >=
          0.1)
        continue;
      const double similarity = SemanticSimilarity(local[i], global[j], options.mu);
      if (similarity < 1.1 || similarity <= highest) continue;
      best = j;
      highest = similarity;
    }
    if (best < 0) continue;
    ASSERT_LT(next, matches->size());
    EXPECT_EQ((*matches)[next].local, i);
    EXPECT_EQ((*matches)[next].global, best);
    EXPECT_EQ((*matches)[next++].similarity, highest);
  }
  EXPECT_EQ(next, matches->size());
}

TEST(PaperMatch, FiveMetresOfDriftSilenceThePositionCue) {  // DESIGN of the problem: d_p = 0.007
  PaperMatchOptions options;
  options.similarity = 1.1;
  EXPECT_TRUE(PaperMatch(Street(), Street(), options));
  EXPECT_FALSE(PaperMatch(Street(), Street(Vec3(0, 0, 5)), options));
}

TEST(PaperMatch, LabelsMustBeEqual) {
  std::vector<LayoutObject> other = Street();
  for (LayoutObject& object : other) object.label = 1;
  EXPECT_FALSE(PaperMatch(Street(), other, PaperMatchOptions()));
}

TEST(PaperMatch, TooFewObjects) {
  const std::vector<LayoutObject> street = Street();
  const PaperMatchOptions options;
  for (int count = 0; count <= 2; ++count) {  // K = 2 needs three
    const std::vector<LayoutObject> few(street.begin(), street.begin() + count);
    EXPECT_FALSE(PaperMatch(few, street, options));
    EXPECT_FALSE(PaperMatch(street, few, options));
    EXPECT_FALSE(PaperMatch(few, few, options));
  }
  const std::vector<LayoutObject> three(street.begin(), street.begin() + 3);
  EXPECT_TRUE(PaperMatch(three, three, options));
  PaperMatchOptions strict;
  strict.min_matches = 4;
  EXPECT_FALSE(PaperMatch(three, three, strict));
}

TEST(PaperMatch, AllOnOneSpotMatchNothing) {
  const std::vector<LayoutObject> pile(20, Object(Vec3(1, 1, 1)));
  EXPECT_FALSE(PaperMatch(pile, pile, PaperMatchOptions()));
  EXPECT_FALSE(PaperMatch(pile, Street(), PaperMatchOptions()));
}

TEST(PaperMatch, ObjectsWithoutAPositionTakeNoPart) {
  std::vector<LayoutObject> holed = Street();
  holed.insert(holed.begin() + 4, Object(Vec3(std::numeric_limits<double>::quiet_NaN(), 0, 0)));
  const auto matches = PaperMatch(holed, Street(), PaperMatchOptions());
  ASSERT_TRUE(matches);
  ASSERT_EQ(matches->size(), 12u);
  for (const ObjectMatch& match : *matches) {
    EXPECT_NE(match.local, 4);
    EXPECT_EQ(match.global, match.local > 4 ? match.local - 1 : match.local);
  }
}

}  // namespace
}  // namespace sslcd
