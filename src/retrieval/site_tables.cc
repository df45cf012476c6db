// SPDX-License-Identifier: BSD-3-Clause
#include "retrieval/site_tables.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "sslcd/core/error.h"

namespace sslcd {
namespace {

// Centres of constellations are stored in 16 bits.
constexpr double kMostSpan = 60e3;  // [m]
constexpr std::size_t kMostLabels = 0xFFFF, kMostSites = 0xFFFFFF;

bool IsPlaced(const SiteObject& object) {
  return std::isfinite(object.x) && std::isfinite(object.y);
}

// The middle of the objects, in whole metres. Throws if they are too far apart.
SiteTables::Row RowOf(const Site& site) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double left = kInfinity, right = -kInfinity, bottom = kInfinity, top = -kInfinity;
  for (const SiteObject& object : site.objects) {
    if (!IsPlaced(object)) continue;
    left = std::min(left, object.x), right = std::max(right, object.x);
    bottom = std::min(bottom, object.y), top = std::max(top, object.y);
  }
  if (left > right) return {site.name, 0, 0, 0};
  if (!(right - left <= kMostSpan && top - bottom <= kMostSpan))
    throw Error(ErrorKind::kBadInput, site.name +
                                          ": its objects span more than 60 km; index its "
                                          "parts as sites of their own");
  return {site.name, std::round(left + (right - left) / 2), std::round(bottom + (top - bottom) / 2),
          0};
}

struct Placed {
  float x, y;
  const std::string* label;
};

// The order does not depend on that of the objects, so that what is read from an index gives the
// same again.
std::vector<Placed> SortedByX(const Site& site, const SiteTables::Row& row) {
  std::vector<Placed> sorted;
  for (const SiteObject& object : site.objects)
    if (IsPlaced(object))
      sorted.push_back({static_cast<float>(object.x - row.x), static_cast<float>(object.y - row.y),
                        &object.label});
  std::sort(sorted.begin(), sorted.end(), [](const Placed& a, const Placed& b) {
    return std::tie(a.x, a.y, *a.label) < std::tie(b.x, b.y, *b.label);
  });
  return sorted;
}

// A place that the objects of a site are seen from already.
struct Origin {
  double x = 0, y = 0;  // [m]
};

void Add(const Site& site, const std::optional<Origin>& origin, SiteTables& tables) {
  if (tables.names.count(site.name) > 0)
    throw Error(ErrorKind::kBadInput, site.name + ": is in the index already; name each map once");
  if (tables.sites.size() >= kMostSites)
    throw Error(ErrorKind::kBadInput, "too many sites for one index; make several");
  SiteTables::Row row = RowOf(site);
  if (origin) row.x = row.y = 0;
  std::set<std::string> fresh;
  for (const SiteObject& object : site.objects)
    if (tables.labels.count(object.label) == 0) fresh.insert(object.label);
  if (tables.labels.size() + fresh.size() > kMostLabels)
    throw Error(ErrorKind::kBadInput,
                site.name +
                    ": with its labels there are more than 65535; use the labels of the "
                    "detector's classes");
  row.first_point = tables.points.size();
  for (const Placed& placed : SortedByX(site, row)) {
    const auto number = static_cast<std::uint16_t>(tables.labels.size());
    const std::uint16_t label = tables.labels.insert({*placed.label, number}).first->second;
    tables.points.push_back({placed.x, placed.y, label, 0});
  }
  if (origin) row.x = origin->x, row.y = origin->y;
  tables.names.insert(site.name);
  tables.sites.push_back(std::move(row));
}

// As they were with so many sites, labels and points.
void Shorten(SiteTables& tables, std::size_t sites, std::size_t labels, std::size_t points) {
  for (std::size_t i = sites; i < tables.sites.size(); ++i)
    tables.names.erase(tables.sites[i].name);
  tables.sites.resize(sites);
  tables.points.resize(points);
  for (auto label = tables.labels.begin(); label != tables.labels.end();)
    label = label->second < labels ? std::next(label) : tables.labels.erase(label);
}

}  // namespace

void AddSite(const Site& site, SiteTables& tables) { Add(site, std::nullopt, tables); }

void AddSites(const SiteFile& file, SiteTables& tables) {
  const std::size_t sites = tables.sites.size(), labels = tables.labels.size(),
                    points = tables.points.size();
  try {
    for (std::uint32_t i = 0; i < file.sites(); ++i) {
      Site site{std::string(file.name(i)), {}};
      for (const SitePoint& point : file.points(i))
        site.objects.push_back({std::string(file.label(point.label)), point.x, point.y});
      Add(site, Origin{file.site(i).x, file.site(i).y}, tables);
    }
  } catch (...) {
    Shorten(tables, sites, labels, points);
    throw;
  }
}

}  // namespace sslcd
