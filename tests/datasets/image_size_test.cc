// SPDX-License-Identifier: BSD-3-Clause
#include "datasets/image_size.h"

#include <sys/stat.h>

#include "temp_folder.h"

namespace sslcd {
namespace {

constexpr ImageSize kNone{};

TEST(ReadImageSize, OfHeaders) {
  using std::string_literals::operator""s;
  const TempFolder folder;
  const auto size_of = [&](const std::string& bytes) {
    return ReadImageSize(folder.Write("image", bytes));
  };
  const std::string png = "\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\x02\x80\0\0\x01\xe0"s;
  EXPECT_EQ(size_of(png), (ImageSize{640, 480}));
  EXPECT_EQ(size_of(png.substr(0, png.size() - 1)), kNone);
  const std::string jpeg = "\xff\xd8\xff\xe0\0\x04zz\xff\xc0\0\x0b\x08\x01\xe0\x02\x80\x01"s;
  EXPECT_EQ(size_of(jpeg), (ImageSize{640, 480}));
  EXPECT_EQ(size_of(jpeg.substr(0, 14)), kNone);
  EXPECT_EQ(size_of("GIF89a"), kNone);
  EXPECT_EQ(size_of(""), kNone);
}

TEST(ReadImageSize, OfWhatIsNoFile) {
  const TempFolder folder;
  ASSERT_EQ(::mkfifo(folder.In("pipe.png").c_str(), 0600), 0);
  for (const std::string& path : {folder.In("pipe.png"), folder.In("none"), folder.path()})
    EXPECT_EQ(ReadImageSize(path), kNone) << path;
}

}  // namespace
}  // namespace sslcd
