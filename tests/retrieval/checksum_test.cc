// SPDX-License-Identifier: BSD-3-Clause
#include "retrieval/checksum.h"

#include <gmock/gmock.h>

#include <set>
#include <string>

namespace sslcd {
namespace {

TEST(FastChecksum, ChangesWithEveryBitAndWithTheLength) {
  for (const std::size_t size : {0, 1, 7, 8, 33, 64, 71}) {
    std::string bytes(size, 'a');
    std::set<std::uint64_t> seen = {FastChecksum(bytes.data(), size)};
    for (std::size_t bit = 0; bit < 8 * size; ++bit) {
      bytes[bit / 8] = static_cast<char>(bytes[bit / 8] ^ 1 << bit % 8);
      seen.insert(FastChecksum(bytes.data(), size));
      bytes[bit / 8] = static_cast<char>(bytes[bit / 8] ^ 1 << bit % 8);
    }
    EXPECT_EQ(seen.size(), 8 * size + 1);
  }
  const std::string zeros(100, '\0');
  EXPECT_NE(FastChecksum(zeros.data(), 40), FastChecksum(zeros.data(), 41));
}

}  // namespace
}  // namespace sslcd
