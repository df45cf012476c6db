// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "sslcd/closing/localisation.h"
#include "sslcd/core/export.h"
#include "sslcd/core/landmark.h"
#include "sslcd/core/pose.h"

namespace SSLCD_EXPORT sslcd {

/// An object of a site, or of a stretch of a drive. Coordinates are horizontal and gravity-aligned
/// (x along GravityFrame::forward, y along `left`), with the origin anywhere. [m]
struct SiteObject {
  std::string label;
  double x = 0, y = 0;
};

/// A map among many.
struct Site {
  std::string name;  ///< e.g. the path of the map
  std::vector<SiteObject> objects;
};

/// The objects of a map to localise in. Throws Error(kBadInput) if a label has no name.
std::vector<SiteObject> SiteObjectsOf(const ReferenceMap& map);
/// The confirmed landmarks of a mapper or of map.json.
std::vector<SiteObject> SiteObjectsOf(const std::vector<MapObject>& landmarks,
                                      const GravityFrame& gravity);

/// A site that a stretch may be from, and where. A point p of the stretch is at Rz(yaw) p + (x, y)
/// of the site's coordinates, to about a metre.
struct SiteCandidate {
  int site = -1;     ///< number in the index, from 0 on
  std::string name;  ///< Site::name
  /// log likelihood ratio of the objects under the pose, against objects by chance [nats]
  double score = 0;
  int matches = 0;  ///< objects of the stretch with one of the site at their place
  double yaw = 0;   ///< [rad]
  double x = 0, y = 0;
};

/// How much of the file is compared with its checksums when it is opened.
enum class SiteIndexCheck {
  kWhole,   ///< reads the file once
  kHeader,  ///< header and tables only; for large files that are opened often
};

/// An index of many maps in a file: which of them is a stretch of a drive from? The file is mapped
/// into memory and only read, so many processes share it. docs/scale.md has method, format, cost.
class SiteIndex {
 public:
  /// Writes the index of some sites, as a whole or not at all. The same sites in the same order
  /// give the same bytes. A site may have no objects; ignores objects whose position is not finite.
  /// Throws Error(kBadInput) if two sites have one name, if a site spans more than 60 km, or if
  /// there are more than 65535 labels, and Error(kOutput) if the file cannot be written. O(objects
  /// log objects), 300 bytes of memory an object.
  static void Build(const std::vector<Site>& sites, const std::string& path);

  /// Opens a file. Throws Error(kBadInput) if it is missing, cut short, damaged, of another version
  /// or no index of sites. Do not shorten a file that is open.
  explicit SiteIndex(const std::string& path, SiteIndexCheck check = SiteIndexCheck::kWhole);
  ~SiteIndex();
  SiteIndex(SiteIndex&&) noexcept;
  SiteIndex& operator=(SiteIndex&&) noexcept;

  int size() const;              ///< number of sites
  std::int64_t objects() const;  ///< of all sites
  std::int64_t file_bytes() const;
  std::string name(int site) const;  ///< Site::name; 0 <= site < size()
  Site ReadSite(int site) const;     ///< positions to 1 mm within 10 km; 0 <= site < size()

  /// The sites that a stretch may be from, best first, at most `most`, each once; none if nothing
  /// agrees. The stretch has the objects of about 100 m of path in one frame, seen from any side;
  /// some may be missing, false or wrongly labelled, and they may be 0.5 m off. Labels that no site
  /// has are ignored. Deterministic. Thread-safe. The time is bounded for any number of sites.
  std::vector<SiteCandidate> Find(const std::vector<SiteObject>& stretch, int most = 10) const;

 private:
  friend class SiteIndexBuilder;
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Makes the index of sites that do not fit into memory with all their properties: keeps 16 bytes
/// an object until Write.
class SiteIndexBuilder {
 public:
  SiteIndexBuilder();
  ~SiteIndexBuilder();
  SiteIndexBuilder(SiteIndexBuilder&&) noexcept;
  SiteIndexBuilder& operator=(SiteIndexBuilder&&) noexcept;

  /// Throws what SiteIndex::Build throws, and leaves the builder as it was.
  void Add(const Site& site);
  /// Adds all sites of another index, or none: with more sites added after them, this extends an
  /// index, and gives the bytes of one that is built at once. Throws likewise.
  void Add(const SiteIndex& index);
  /// Writes the index of what has been added.
  void Write(const std::string& path) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sslcd
