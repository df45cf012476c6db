// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "retrieval/checksum.h"
#include "retrieval/constellation_key.h"
#include "retrieval/site_file.h"
#include "retrieval/site_tables.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

std::vector<SitePoint> PointsOf(const SiteTables& tables, std::size_t site) {
  const std::size_t end =
      site + 1 < tables.sites.size() ? tables.sites[site + 1].first_point : tables.points.size();
  const auto first = tables.points.begin();
  return {first + static_cast<std::ptrdiff_t>(tables.sites[site].first_point),
          first + static_cast<std::ptrdiff_t>(end)};
}

// Calls visit(site, constellation, key) for all constellations of all sites.
template <class Visitor>
void VisitAll(const SiteTables& tables, Visitor&& visit) {
  for (std::size_t site = 0; site < tables.sites.size(); ++site) {
    const std::vector<SitePoint> points = PointsOf(tables, site);
    VisitConstellations(points, NearestNeighbours(points), [&](const Constellation& one) {
      visit(static_cast<std::uint32_t>(site), one, KeyOf(one));
    });
  }
}

SiteEntry EntryOf(std::uint32_t site, const Constellation& one, std::uint32_t inside) {
  SiteEntry entry{};
  entry.site = site & 0xFFFFFF;
  entry.x = static_cast<std::int16_t>(std::lround(one.x));
  entry.y = static_cast<std::int16_t>(std::lround(one.y));
  entry.yaw = StepsOfTurn(one.axis_x, one.axis_y);
  entry.inside = inside;
  return entry;
}

// The number of buckets is at most twice that of the points.
std::uint64_t BitsFor(std::size_t points) {
  std::uint64_t bits = 1;
  while (bits < 31 && (std::size_t{2} << bits) <= 2 * points) ++bits;
  return bits;
}

void WriteNames(const SiteTables& tables, const SiteSections& at, std::string& bytes) {
  std::uint64_t name = 0;
  const auto put = [&](const std::string& text) {
    std::memcpy(&bytes[at.names + name], text.data(), text.size());
    name += text.size();
  };
  auto* row = reinterpret_cast<SiteRow*>(&bytes[at.sites]);
  for (const SiteTables::Row& site : tables.sites) {
    *row++ = {site.first_point, name, site.x, site.y};
    put(site.name);
  }
  *row = {tables.points.size(), name, 0, 0};
  std::vector<const std::string*> labels(tables.labels.size());
  for (const auto& [text, number] : tables.labels) labels[number] = &text;
  auto* begin = reinterpret_cast<std::uint64_t*>(&bytes[at.labels]);
  for (const std::string* label : labels) {
    *begin++ = name;
    put(*label);
  }
  *begin = name;
}

// Starts of the buckets from their sizes in starts[bucket + 1].
void SumUp(std::vector<std::uint32_t>& starts) {
  for (std::size_t i = 1; i < starts.size(); ++i) starts[i] += starts[i - 1];
}

}  // namespace

std::string SiteFileBytes(const SiteTables& tables) {
  SiteFileHeader header;
  header.sites = tables.sites.size();
  header.labels = tables.labels.size();
  for (const SiteTables::Row& site : tables.sites) header.name_bytes += site.name.size();
  for (const auto& label : tables.labels) header.name_bytes += label.first.size();
  header.points = tables.points.size();
  header.bucket_bits = BitsFor(tables.points.size());
  std::vector<std::uint32_t> starts((std::size_t{1} << header.bucket_bits) + 1, 0);
  VisitAll(tables, [&](std::uint32_t, const Constellation&, const ConstellationKey& key) {
    ++starts[BucketOf(key.cell, header.bucket_bits) + 1];
    ++header.entries;
  });
  if (header.entries > 0xFFFFFFFF)
    throw Error(ErrorKind::kBadInput, "too many objects for one index; make several");
  SumUp(starts);
  const SiteSections at = SectionsOf(header);
  header.file_bytes = at.end;
  std::string bytes(at.end, '\0');
  WriteNames(tables, at, bytes);
  if (!tables.points.empty())
    std::memcpy(&bytes[at.points], tables.points.data(), header.points * sizeof(SitePoint));
  std::memcpy(&bytes[at.starts], starts.data(), starts.size() * sizeof(std::uint32_t));
  auto* entries = reinterpret_cast<SiteEntry*>(bytes.data() + at.entries);
  VisitAll(tables, [&](std::uint32_t site, const Constellation& one, const ConstellationKey& key) {
    entries[starts[BucketOf(key.cell, header.bucket_bits)]++] = EntryOf(site, one, key.inside);
  });
  header.tables_checksum = FastChecksum(&bytes[at.sites], at.points - at.sites);
  header.body_checksum = FastChecksum(bytes.data() + at.points, at.end - at.points);
  std::memcpy(bytes.data(), &header, sizeof header);
  header.checksum = FastChecksum(bytes.data(), offsetof(SiteFileHeader, checksum));
  std::memcpy(bytes.data(), &header, sizeof header);
  return bytes;
}

}  // namespace sslcd
