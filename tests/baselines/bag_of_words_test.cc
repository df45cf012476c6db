// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/bag_of_words.h"

#include <gtest/gtest.h>

#include <random>

namespace sslcd::baselines {
namespace {

using Image = std::vector<BinaryDescriptor>;

BinaryDescriptor Noisy(BinaryDescriptor descriptor, int bits, std::mt19937_64& engine) {
  for (int i = 0; i < bits; ++i) {
    const auto bit = engine() % 256;
    descriptor[bit / 64] ^= std::uint64_t{1} << (bit % 64);
  }
  return descriptor;
}

// Each image shows 30 of 200 things, every sighting with up to ten bits wrong.
struct Things {
  std::mt19937_64 engine{1};
  Image things;
  Things() {
    for (int i = 0; i < 200; ++i) things.push_back({engine(), engine(), engine(), engine()});
  }
  Image See(int first) {
    Image image;
    for (int i = first; i < first + 30; ++i) image.push_back(Noisy(things[i % 200], 10, engine));
    return image;
  }
};

TEST(BagOfWords, BitsThatDiffer) {
  EXPECT_EQ(HammingDistance({0, 0, 0, 0}, {0, 0, 0, 0}), 0);
  EXPECT_EQ(HammingDistance({1, 0, 0, 0}, {2, 0, 0, ~std::uint64_t{0}}), 66);
}

TEST(BagOfWords, SimilarityOfWords) {
  const WordVector v{{1, 0.5}, {2, 0.5}}, w{{2, 0.25}, {3, 0.75}};
  EXPECT_NEAR(Similarity(v, v), 1, 1e-12);
  EXPECT_NEAR(Similarity(v, w), 0.25, 1e-12);  // 1 - (0.5 + 0.25 + 0.75) / 2
  EXPECT_EQ(Similarity(v, {{7, 1.}}), 0);
  EXPECT_EQ(Similarity(v, {}), 0);
}

TEST(BagOfWords, ImagesThatShareThingsAreSimilar) {
  Things things;
  std::vector<Image> training;
  for (int i = 0; i < 200; i += 10) training.push_back(things.See(i));
  const Vocabulary vocabulary(training, 6, 4);
  EXPECT_GT(vocabulary.size(), 50);
  const WordVector here = vocabulary.Words(things.See(40));
  double sum = 0;
  for (const auto& [word, weight] : here) sum += weight;
  EXPECT_NEAR(sum, 1, 1e-9);
  const double again = Similarity(here, vocabulary.Words(things.See(40)));
  const double half = Similarity(here, vocabulary.Words(things.See(55)));
  const double elsewhere = Similarity(here, vocabulary.Words(things.See(120)));
  EXPECT_GT(again, 0.7);
  EXPECT_GT(again, half + 0.2);
  EXPECT_GT(half, elsewhere + 0.2);
}

TEST(BagOfWords, SameEveryTime) {
  Things a, b;
  const Vocabulary one({a.See(0), a.See(50)}, 4, 3), other({b.See(0), b.See(50)}, 4, 3);
  EXPECT_EQ(one.Words(a.See(20)), other.Words(b.See(20)));
}

TEST(BagOfWords, OddVocabularies) {
  Things things;
  const Image image = things.See(0);
  EXPECT_TRUE(Vocabulary({}, 4, 3).Words(image).empty());
  EXPECT_TRUE(Vocabulary({{}, {}}, 4, 3).Words({}).empty());
  EXPECT_TRUE(Vocabulary({image}, 4, 3).Words(image).empty())
      << "what is in every image says nothing";
  const Image same(50, image[0]);
  EXPECT_EQ(Vocabulary({same, image}, 4, 3).Words(same).size(), 0u);
  EXPECT_GT(Vocabulary({same, {image.begin() + 1, image.end()}}, 4, 3).Words(same).size(), 0u);
}

}  // namespace
}  // namespace sslcd::baselines
