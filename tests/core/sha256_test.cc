// SPDX-License-Identifier: BSD-3-Clause
#include "core/sha256.h"

#include <gtest/gtest.h>

namespace sslcd {
namespace {

// FIPS 180-4, examples of NIST
TEST(Sha256, KnownHashes) {
  const auto hash = [](const std::string& text) {
    return Hexadecimal(Sha256().Add(text).Finish());
  };
  EXPECT_EQ(hash(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(hash("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(hash("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(hash(std::string(1000000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Sha256, PiecesMakeTheSameHash) {
  const std::string text(200, 'x');
  for (std::size_t cut = 0; cut <= text.size(); ++cut)
    EXPECT_EQ(Sha256().Add(text.substr(0, cut)).Add(text.substr(cut)).Finish(),
              Sha256().Add(text).Finish());
}

}  // namespace
}  // namespace sslcd
