// SPDX-License-Identifier: BSD-3-Clause
#include "retrieval/site_file.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "retrieval/checksum.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

constexpr std::uint64_t kMostCount = std::uint64_t{1} << 40, kMostBits = 31;
constexpr std::uint64_t kMostSites = 0xFFFFFF, kMostLabels = 0xFFFF;

[[noreturn]] void Refuse(const std::string& path, const std::string& problem) {
  throw Error(ErrorKind::kBadInput,
              path + ": " + problem + "; make it with `sslcd_run sites index`");
}

SiteFileHeader ReadHeader(const std::string& path, const MappedFile& file) {
  SiteFileHeader header;
  const SiteFileHeader expected;
  const std::size_t known = std::min(file.size(), sizeof header.magic);
  if (known == 0) Refuse(path, "the file is empty");
  if (std::memcmp(file.data(), expected.magic, known) != 0) Refuse(path, "is no index of sites");
  if (file.size() < sizeof header) Refuse(path, "is cut short, in its header");
  std::memcpy(&header, file.data(), sizeof header);
  if (header.byte_order != expected.byte_order && header.version != expected.version)
    Refuse(path, "was written on a computer with another order of bytes");
  if (header.version != expected.version)
    Refuse(path, "has version " + std::to_string(header.version) +
                     ", and this program knows version " + std::to_string(expected.version));
  if (FastChecksum(file.data(), offsetof(SiteFileHeader, checksum)) != header.checksum)
    Refuse(path, "is damaged: its header does not have its checksum");
  const bool possible = header.sites <= kMostSites && header.labels <= kMostLabels &&
                        header.name_bytes < kMostCount && header.points < kMostCount &&
                        header.bucket_bits >= 1 && header.bucket_bits <= kMostBits &&
                        header.entries <= 0xFFFFFFFF;
  if (!possible || header.file_bytes != SectionsOf(header).end)
    Refuse(path, "is damaged: its header contradicts itself");
  if (file.size() < header.file_bytes)
    Refuse(path, "is cut short: it has " + std::to_string(file.size()) + " of " +
                     std::to_string(header.file_bytes) + " bytes");
  if (file.size() > header.file_bytes) Refuse(path, "is damaged: something follows its end");
  return header;
}

}  // namespace

SiteSections SectionsOf(const SiteFileHeader& header) {
  std::uint64_t end = sizeof(SiteFileHeader);
  const auto next = [&](std::uint64_t bytes) {
    const std::uint64_t begin = (end + 15) / 16 * 16;
    end = begin + bytes;
    return begin;
  };
  SiteSections at;
  at.sites = next((header.sites + 1) * sizeof(SiteRow));
  at.labels = next((header.labels + 1) * sizeof(std::uint64_t));
  at.names = next(header.name_bytes);
  at.points = next(header.points * sizeof(SitePoint));
  at.starts = next(((std::uint64_t{1} << header.bucket_bits) + 1) * sizeof(std::uint32_t));
  at.entries = next(header.entries * sizeof(SiteEntry));
  at.end = end;
  return at;
}

SiteFile::SiteFile(const std::string& path, SiteIndexCheck check)
    : file_(path), header_(ReadHeader(path, file_)), at_(SectionsOf(header_)) {
  if (FastChecksum(file_.data() + at_.sites, at_.points - at_.sites) != header_.tables_checksum)
    Refuse(path, "is damaged: the table of its sites does not have its checksum");
  CheckTables(path);
  if (check == SiteIndexCheck::kWhole &&
      FastChecksum(file_.data() + at_.points, at_.end - at_.points) != header_.body_checksum)
    Refuse(path, "is damaged: its content does not have its checksum");
}

// So that no function reads outside of the file, even of one that was made to deceive.
void SiteFile::CheckTables(const std::string& path) const {
  std::uint64_t point = 0, name = 0;
  bool ordered = true;
  for (std::uint64_t i = 0; i <= header_.sites; ++i) {
    const SiteRow& row = At<SiteRow>(at_.sites)[i];
    ordered = ordered && row.first_point >= point && row.first_point <= header_.points &&
              row.name >= name && row.name <= header_.name_bytes && std::isfinite(row.x) &&
              std::isfinite(row.y);
    point = row.first_point;
    name = row.name;
  }
  for (std::uint64_t i = 0; i <= header_.labels; ++i) {
    const std::uint64_t begin = At<std::uint64_t>(at_.labels)[i];
    ordered = ordered && begin >= name && begin <= header_.name_bytes;
    name = begin;
  }
  if (!ordered) Refuse(path, "is damaged: the table of its sites contradicts itself");
}

std::string_view SiteFile::name(std::uint32_t number) const {
  const std::uint64_t begin = site(number).name;
  return {At<char>(at_.names + begin), static_cast<std::size_t>(site(number + 1).name - begin)};
}

std::string_view SiteFile::label(std::uint16_t number) const {
  if (number >= header_.labels) return {};
  const std::uint64_t* const begin = At<std::uint64_t>(at_.labels) + number;
  return {At<char>(at_.names + begin[0]), static_cast<std::size_t>(begin[1] - begin[0])};
}

Span<SitePoint> SiteFile::points(std::uint32_t number) const {
  const SitePoint* const all = At<SitePoint>(at_.points);
  return {all + site(number).first_point, all + site(number + 1).first_point};
}

Span<SiteEntry> SiteFile::bucket(std::uint64_t cell) const {
  const std::uint32_t* const start =
      At<std::uint32_t>(at_.starts) + BucketOf(cell, header_.bucket_bits);
  const SiteEntry* const all = At<SiteEntry>(at_.entries);
  if (start[0] > start[1] || start[1] > header_.entries) return {};
  return {all + start[0], all + start[1]};
}

void SiteFile::PrefetchBucket(std::uint64_t cell) const {
  __builtin_prefetch(At<std::uint32_t>(at_.starts) + BucketOf(cell, header_.bucket_bits));
}

}  // namespace sslcd
