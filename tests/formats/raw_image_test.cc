// SPDX-License-Identifier: BSD-3-Clause
#include "formats/raw_image.h"

#include <sys/stat.h>

#include <map>

#include "temp_folder.h"

namespace sslcd {
namespace {

using testing::ElementsAre;

/// An unsigned number of so many bytes, the first the lowest or the highest.
std::string Bytes(std::uint64_t value, int count, bool little = true) {
  std::string bytes;
  for (int i = 0; i < count; ++i)
    bytes += static_cast<char>(value >> 8 * (little ? i : count - 1 - i));
  return bytes;
}

/// The bytes first, first + 1, ...
std::string Counting(int first, int count) {
  std::string bytes;
  for (int i = 0; i < count; ++i) bytes += static_cast<char>(first + i);
  return bytes;
}

/// 2 x 2 pixels of the bytes 1, 2, 3, ...; rows are filled up to four bytes.
std::string Bmp(int bits, std::uint32_t height, std::uint32_t compression = 0) {
  std::string table, pixels;
  for (int i = 0; bits == 8 && i < 256; ++i) table += std::string(3, static_cast<char>(i)) + '\0';
  const int row_bytes = 2 * bits / 8;
  for (int row = 0; row < 2; ++row) {
    pixels += Counting(1 + row * row_bytes, row_bytes);
    pixels.resize((pixels.size() + 3) / 4 * 4);
  }
  return "BM" + Bytes(0, 8) + Bytes(54 + static_cast<std::uint32_t>(table.size()), 4) +
         Bytes(40, 4) + Bytes(2, 4) + Bytes(height, 4) + Bytes(1, 2) + Bytes(bits, 2) +
         Bytes(compression, 4) + std::string(20, '\0') + table + pixels;
}

using TiffValues = std::map<std::uint32_t, std::uint32_t>;  // tag -> value

/// A TIFF of 2 x 2 pixels of the bytes 1, 2, 3, ... in strips of one row; the directory is at its
/// end. `other` replaces or adds fields.
std::string Tiff(bool little, std::uint32_t samples, const TiffValues& other = {}) {
  const auto number = [&](std::uint32_t value, int count) { return Bytes(value, count, little); };
  const std::uint32_t strips = 8 + 4 * samples, bits = strips + 8, directory = bits + 8;
  TiffValues values = {{256, 2},
                       {257, 2},
                       {258, samples == 1 ? 8 : bits},
                       {259, 1},
                       {262, samples == 1 ? 1u : 2u},
                       {273, strips},
                       {277, samples},
                       {278, 1}};
  for (const auto& [tag, value] : other) values[tag] = value;
  std::string text = little ? std::string("II*\0", 4) : std::string("MM\0*", 4);
  text += number(directory, 4) + Counting(1, static_cast<int>(4 * samples));
  text += number(8, 4) + number(8 + 2 * samples, 4);
  for (int i = 0; i < 4; ++i) text += number(8, 2);
  text += number(static_cast<std::uint32_t>(values.size()), 2);
  for (const auto& [tag, value] : values) {
    const bool is_bits = tag == 258 && samples > 1;  // places of 16 bits
    text += number(tag, 2) + number(is_bits ? 3 : 4, 2) +
            number(is_bits      ? samples
                   : tag == 273 ? 2
                                : 1,
                   4) +
            number(value, 4);
  }
  return text + number(0, 4);
}

Image Read(const std::string& bytes) {
  const TempFolder folder;
  return ReadRawImage(folder.Write("image", bytes));
}

void ExpectRefused(const std::string& bytes, const std::string& why) {
  const TempFolder folder;
  const std::string path = folder.Write("image", bytes);
  ExpectError([&] { ReadRawImage(path); }, {path, why, "save it as PNG"});
}

TEST(ReadRawImage, Bmp) {
  const Image colour = Read(Bmp(24, 2));
  EXPECT_EQ(colour.channels, 3);
  EXPECT_THAT(colour.pixels, ElementsAre(7, 8, 9, 10, 11, 12, 1, 2, 3, 4, 5, 6)) << "from below";
  EXPECT_THAT(Read(Bmp(24, static_cast<std::uint32_t>(-2))).pixels,
              ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12));
  EXPECT_THAT(Read(Bmp(32, 2)).pixels, ElementsAre(9, 10, 11, 13, 14, 15, 1, 2, 3, 5, 6, 7));
  const Image grey = Read(Bmp(8, 2));
  EXPECT_EQ(grey.channels, 1);
  EXPECT_THAT(grey.pixels, ElementsAre(3, 4, 1, 2));
}

TEST(ReadRawImage, TiffOfBothByteOrders) {
  for (const bool little : {true, false}) {
    const Image colour = Read(Tiff(little, 3));
    EXPECT_EQ(colour.width, 2);
    EXPECT_THAT(colour.pixels, ElementsAre(3, 2, 1, 6, 5, 4, 9, 8, 7, 12, 11, 10)) << "B G R";
    EXPECT_THAT(Read(Tiff(little, 4)).pixels, ElementsAre(3, 2, 1, 7, 6, 5, 11, 10, 9, 15, 14, 13));
    const Image grey = Read(Tiff(little, 1));
    EXPECT_EQ(grey.channels, 1);
    EXPECT_THAT(grey.pixels, ElementsAre(1, 2, 3, 4));
  }
}

TEST(ReadRawImage, RefusesOtherKinds) {
  ExpectRefused("GIF89a and more", "neither a BMP nor a TIFF");
  ExpectRefused(Bmp(24, 2, 1), "compressed BMP");
  ExpectRefused(Bmp(32, 2, 3), "bit fields instead of 24 bits a pixel");
  ExpectRefused(Bmp(16, 2), "16 bits a pixel");
  std::string coloured = Bmp(8, 2);
  coloured[54 + 4 * 200] = 7;
  ExpectRefused(coloured, "table of colours");
  const std::pair<TiffValues, std::string> kinds[] = {
      {{{259, 5}}, "compressed TIFF"},         {{{322, 16}}, "in tiles"},
      {{{284, 2}}, "a plane for each colour"}, {{{258, 16}}, "16 bits a channel"},
      {{{262, 0}}, "neither grey nor R G B"},  {{{277, 2}}, "2 channels"},
      {{{278, 0}}, "where its pixels are"},    {{{257, 9}}, "where its pixels are"}};
  for (const auto& [values, why] : kinds) ExpectRefused(Tiff(true, 1, values), why);
}

TEST(ReadRawImage, RefusesWhatEndsTooEarlyOrClaimsTooMuch) {
  for (const std::string& whole : {Bmp(24, 2), Bmp(8, 2), Tiff(true, 3), Tiff(false, 1)})
    for (std::size_t size = 0; size + 4 < whole.size(); ++size)  // the last four are not read
      ExpectRefused(whole.substr(0, size), "");
  ExpectRefused(Bmp(24, 3), "shorter than its pixels");
  ExpectRefused(Bmp(24, 1u << 31), "x 2147483648 pixels");
  ExpectRefused(Bmp(24, 0), "x 0 pixels");
  // Many rows at one place are no way to ask for much memory.
  ExpectRefused(Tiff(true, 1, {{257, 60000}, {278, 1u << 31}}), "shorter than its pixels");
}

TEST(IsRawImage, ByTheFirstBytes) {
  const TempFolder folder;
  EXPECT_TRUE(IsRawImage(folder.Write("a", Bmp(24, 2))));
  EXPECT_TRUE(IsRawImage(folder.Write("a", Tiff(false, 1))));
  EXPECT_FALSE(IsRawImage(folder.Write("a", "\x89PNG\r\n\x1a\n and more")));
  EXPECT_FALSE(IsRawImage(folder.Write("a", "BM")));
  ASSERT_EQ(::mkfifo(folder.In("pipe").c_str(), 0600), 0);
  EXPECT_FALSE(IsRawImage(folder.In("pipe")));
  EXPECT_FALSE(IsRawImage(folder.In("none")));
  ExpectError([&] { ReadRawImage(folder.In("none")); }, {"none"});
}

}  // namespace
}  // namespace sslcd
