// SPDX-License-Identifier: BSD-3-Clause
#include "check/embeddings.h"

#include <gmock/gmock.h>
#include <Eigen/Core>

#include "drive.h"

namespace sslcd::check {
namespace {

using testing::ElementsAre;

TEST(Embeddings, ShuffledConstantEmpty) {
  Sequence s = MakeDrive();
  const auto each = [&s](auto change) {
    for (std::size_t i = 0; i < s.rows.size(); ++i)
      change(i, s.rows[i].detection.appearance[Cue::kEmbedding]);
  };
  each([](std::size_t, std::vector<float>& v) {
    Eigen::Map<Eigen::VectorXf>(v.data(), 8).normalize();
  });
  EXPECT_EQ(IdOf(CheckEmbeddings(s)), "ok");
  const Sequence sound = s;
  each([&](std::size_t i, std::vector<float>& v) {
    v = sound.rows[(i * 7919) % sound.rows.size()].detection.appearance[Cue::kEmbedding];
  });
  EXPECT_EQ(IdOf(CheckEmbeddings(s)), "embeddings_shuffled");
  each([](std::size_t, std::vector<float>& v) { v = {1, 0}; });
  EXPECT_EQ(IdOf(CheckEmbeddings(s)), "embeddings_constant");
  each([](std::size_t, std::vector<float>& v) { v.clear(); });
  EXPECT_EQ(IdOf(CheckEmbeddings(s)), "embeddings_empty");
  s.has_embeddings = false;
  EXPECT_EQ(IdOf(CheckEmbeddings(s)), "not testable");
}

}  // namespace
}  // namespace sslcd::check
