// SPDX-License-Identifier: BSD-3-Clause
#include "report/base64.h"

#include <gtest/gtest.h>

namespace sslcd {
namespace {

TEST(Base64, ExamplesOfRfc4648) {
  EXPECT_EQ(Base64(""), "");
  EXPECT_EQ(Base64("f"), "Zg==");
  EXPECT_EQ(Base64("fo"), "Zm8=");
  EXPECT_EQ(Base64("foo"), "Zm9v");
  EXPECT_EQ(Base64("foobar"), "Zm9vYmFy");
}

TEST(Base64, AllBits) { EXPECT_EQ(Base64(std::string("\xff\xef\xbe\0", 4)), "/+++AA=="); }

}  // namespace
}  // namespace sslcd
