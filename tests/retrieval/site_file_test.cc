// SPDX-License-Identifier: BSD-3-Clause
#include "retrieval/site_file.h"

#include <gmock/gmock.h>

#include <cstring>

#include "../support/temp_folder.h"
#include "random_sites.h"
#include "retrieval/checksum.h"
#include "retrieval/site_tables.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

using testing::HasSubstr;

std::string GoodBytes() {
  SiteTables tables;
  AddSite(RandomSite("a", 1, 40), tables);
  AddSite(RandomSite("b", 2, 40), tables);
  return SiteFileBytes(tables);
}

std::string Put(const std::string& bytes) {
  static const TempFolder folder;
  return folder.Write("test.sites", bytes);
}

// What opening the bytes says; empty: nothing.
std::string Problem(const std::string& bytes, SiteIndexCheck check = SiteIndexCheck::kWhole) {
  const std::string path = Put(bytes);
  try {
    const SiteIndex index(path, check);
    index.Find(StretchOfSite(RandomSite("a", 1, 40), 0, 0));
    for (int i = 0; i < index.size(); ++i) index.ReadSite(i);
    return "";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kBadInput);
    EXPECT_THAT(error.what(), HasSubstr(path));
    return error.what();
  }
}

// As if the file had been made so: all checksums are right.
std::string Signed(std::string bytes) {
  SiteFileHeader header;
  std::memcpy(&header, bytes.data(), sizeof header);
  const SiteSections at = SectionsOf(header);
  header.tables_checksum = FastChecksum(&bytes[at.sites], at.points - at.sites);
  header.body_checksum = FastChecksum(&bytes[at.points], at.end - at.points);
  std::memcpy(bytes.data(), &header, sizeof header);
  header.checksum = FastChecksum(bytes.data(), offsetof(SiteFileHeader, checksum));
  std::memcpy(bytes.data(), &header, sizeof header);
  return bytes;
}

TEST(SiteFile, ReadsWhatWasWritten) {
  const SiteFile file(Put(GoodBytes()), SiteIndexCheck::kWhole);
  EXPECT_EQ(file.sites(), 2u);
  EXPECT_EQ(file.name(1), "b");
  EXPECT_EQ(file.points(1).size(), 40u);
  EXPECT_EQ(file.label(0), "Car");
  EXPECT_EQ(file.label(9), "");
  EXPECT_GT(file.header().entries, 100u);
}

TEST(SiteFile, DamageIsToldApart) {
  const std::string good = GoodBytes();
  EXPECT_EQ(Problem(good), "");
  EXPECT_EQ(Signed(good), good);
  EXPECT_THAT(Problem(""), HasSubstr("empty"));
  EXPECT_THAT(Problem("SQLite format 3"), HasSubstr("no index of sites"));
  EXPECT_THAT(Problem(good.substr(0, 5)), HasSubstr("cut short"));
  EXPECT_THAT(Problem(good.substr(0, 60)), HasSubstr("cut short"));
  EXPECT_THAT(Problem(good.substr(0, good.size() - 1)), HasSubstr("cut short"));
  EXPECT_THAT(Problem(good + "x"), HasSubstr("something follows"));
  std::string other = good;
  other[8] = 2;
  EXPECT_THAT(Problem(other), HasSubstr("has version 2"));
  other = good;
  std::reverse(other.begin() + 8, other.begin() + 12);
  std::reverse(other.begin() + 12, other.begin() + 16);
  EXPECT_THAT(Problem(other), HasSubstr("order of bytes"));
  EXPECT_THROW(SiteIndex("/no/such/file"), Error);
  EXPECT_THROW(SiteIndex{testing::TempDir()}, Error);
}

TEST(SiteFile, EveryFlippedBitIsFound) {
  const std::string good = GoodBytes();
  for (std::size_t byte = 0; byte < good.size(); byte += byte < 200 ? 1 : 197) {
    std::string bad = good;
    bad[byte] = static_cast<char>(bad[byte] ^ 1 << byte % 8);
    EXPECT_NE(Problem(bad), "") << byte;
  }
}

// A file that was made to deceive is read within its bounds, too.
TEST(SiteFile, NothingIsReadOutside) {
  const std::string good = GoodBytes();
  SiteFileHeader header;
  std::memcpy(&header, good.data(), sizeof header);
  const SiteSections at = SectionsOf(header);
  for (std::size_t byte = at.sites; byte < good.size(); byte += byte < at.points ? 5 : 331) {
    std::string bad = good;
    bad[byte] = static_cast<char>(0xFF);
    Problem(Signed(bad));
    Problem(bad, SiteIndexCheck::kHeader);
  }
  for (std::size_t field = 16; field < offsetof(SiteFileHeader, tables_checksum); ++field) {
    std::string bad = good;
    bad[field] = static_cast<char>(0xFF);
    const std::uint64_t hash = FastChecksum(bad.data(), offsetof(SiteFileHeader, checksum));
    std::memcpy(&bad[offsetof(SiteFileHeader, checksum)], &hash, sizeof hash);
    EXPECT_NE(Problem(bad), "") << field;
  }
}

}  // namespace
}  // namespace sslcd
