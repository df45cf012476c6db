// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include "retrieval/mapped_file.h"
#include "retrieval/site_point.h"
#include "sslcd/retrieval/site_index.h"

namespace sslcd {

/// The head of a file of sites. The sections follow in the order of the counts, each at a multiple
/// of 16 bytes. Numbers have the least significant byte first.
struct SiteFileHeader {
  char magic[8] = {'S', 'S', 'L', 'C', 'D', 'S', 'I', 'T'};
  std::uint32_t version = 1;
  std::uint32_t byte_order = 0x01020304;
  std::uint64_t sites = 0;
  std::uint64_t labels = 0;
  std::uint64_t name_bytes = 0;  ///< of all sites and labels
  std::uint64_t points = 0;
  std::uint64_t bucket_bits = 0;  ///< there are 2^bits buckets of constellations
  std::uint64_t entries = 0;
  std::uint64_t file_bytes = 0;
  std::uint64_t tables_checksum = 0;  ///< of the sections before the points
  std::uint64_t body_checksum = 0;    ///< of the points and what follows
  std::uint64_t checksum = 0;         ///< of the header before it
};

/// A row of the first section; a last row has the ends.
struct SiteRow {
  std::uint64_t first_point = 0;
  std::uint64_t name = 0;  ///< its first byte
  double x = 0, y = 0;     ///< origin of its points [m]
};

/// A constellation of a site: 12 bytes.
struct SiteEntry {
  std::uint32_t site : 24;
  std::uint32_t yaw : 8;  ///< of its axis; 256 are a turn
  std::int16_t x, y;      ///< of its centre from the site's origin [m]
  std::uint32_t inside;   ///< ConstellationKey::inside
};

/// The direction of an axis as SiteEntry::yaw.
inline std::uint8_t StepsOfTurn(float axis_x, float axis_y) {
  return static_cast<std::uint8_t>(std::lround(std::atan2(axis_y, axis_x) * (256 / (2 * M_PI))));
}

/// Where the sections begin.
struct SiteSections {
  std::uint64_t sites = 0, labels = 0, names = 0, points = 0, starts = 0, entries = 0, end = 0;
};
/// Of a header with counts below 2^40 and at most 31 bits.
SiteSections SectionsOf(const SiteFileHeader& header);

/// The bucket of ConstellationKey::cell.
inline std::uint64_t BucketOf(std::uint64_t cell, std::uint64_t bits) {
  return cell >> (64 - bits);
}

template <class T>
struct Span {
  const T* first = nullptr;
  const T* last = nullptr;

  const T* begin() const { return first; }
  const T* end() const { return last; }
  std::size_t size() const { return static_cast<std::size_t>(last - first); }
};

/// A file of sites, opened. What its functions return lies inside of the file, whatever it holds.
class SiteFile {
 public:
  /// Throws Error(kBadInput), see SiteIndex.
  SiteFile(const std::string& path, SiteIndexCheck check);

  const SiteFileHeader& header() const { return header_; }
  std::uint32_t sites() const { return static_cast<std::uint32_t>(header_.sites); }
  const SiteRow& site(std::uint32_t number) const { return At<SiteRow>(at_.sites)[number]; }
  std::string_view name(std::uint32_t site) const;
  std::string_view label(std::uint16_t number) const;
  Span<SitePoint> points(std::uint32_t site) const;
  /// The constellations of a cell, and of others with the same bucket.
  Span<SiteEntry> bucket(std::uint64_t cell) const;
  void PrefetchBucket(std::uint64_t cell) const;

 private:
  template <class T>
  const T* At(std::uint64_t offset) const {
    return reinterpret_cast<const T*>(file_.data() + offset);
  }
  void CheckTables(const std::string& path) const;

  MappedFile file_;
  SiteFileHeader header_;
  SiteSections at_;
};

}  // namespace sslcd
