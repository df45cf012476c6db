// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/retrieval/site_index.h"

#include <mutex>
#include <utility>

#include "formats/atomic_file.h"
#include "retrieval/find_site.h"
#include "retrieval/pose_votes.h"
#include "retrieval/site_file.h"
#include "retrieval/site_tables.h"

namespace sslcd {

struct SSLCD_HIDDEN SiteIndex::Impl {
  SiteFile file;
  // Memory of searches that have ended, for the next ones.
  std::mutex mutex;
  std::vector<std::unique_ptr<PoseVotes>> idle;

  std::unique_ptr<PoseVotes> TakeVotes() {
    const std::lock_guard<std::mutex> lock(mutex);
    if (idle.empty()) return std::make_unique<PoseVotes>();
    std::unique_ptr<PoseVotes> votes = std::move(idle.back());
    idle.pop_back();
    return votes;
  }
  void GiveBack(std::unique_ptr<PoseVotes> votes) {
    const std::lock_guard<std::mutex> lock(mutex);
    idle.push_back(std::move(votes));
  }
};

void SiteIndex::Build(const std::vector<Site>& sites, const std::string& path) {
  SiteIndexBuilder builder;
  for (const Site& site : sites) builder.Add(site);
  builder.Write(path);
}

SiteIndex::SiteIndex(const std::string& path, SiteIndexCheck check)
    : impl_(new Impl{SiteFile(path, check), {}, {}}) {}
SiteIndex::~SiteIndex() = default;
SiteIndex::SiteIndex(SiteIndex&&) noexcept = default;
SiteIndex& SiteIndex::operator=(SiteIndex&&) noexcept = default;

int SiteIndex::size() const { return static_cast<int>(impl_->file.sites()); }
std::int64_t SiteIndex::objects() const {
  return static_cast<std::int64_t>(impl_->file.header().points);
}
std::int64_t SiteIndex::file_bytes() const {
  return static_cast<std::int64_t>(impl_->file.header().file_bytes);
}
std::string SiteIndex::name(int site) const {
  return std::string(impl_->file.name(static_cast<std::uint32_t>(site)));
}

Site SiteIndex::ReadSite(int number) const {
  const auto i = static_cast<std::uint32_t>(number);
  const SiteRow& row = impl_->file.site(i);
  Site site{name(number), {}};
  for (const SitePoint& point : impl_->file.points(i))
    site.objects.push_back(
        {std::string(impl_->file.label(point.label)), row.x + point.x, row.y + point.y});
  return site;
}

std::vector<SiteCandidate> SiteIndex::Find(const std::vector<SiteObject>& stretch, int most) const {
  std::unique_ptr<PoseVotes> votes = impl_->TakeVotes();
  std::vector<SiteCandidate> found = FindSites(impl_->file, stretch, most, *votes);
  impl_->GiveBack(std::move(votes));
  return found;
}

struct SSLCD_HIDDEN SiteIndexBuilder::Impl {
  SiteTables tables;
};

SiteIndexBuilder::SiteIndexBuilder() : impl_(std::make_unique<Impl>()) {}
SiteIndexBuilder::~SiteIndexBuilder() = default;
SiteIndexBuilder::SiteIndexBuilder(SiteIndexBuilder&&) noexcept = default;
SiteIndexBuilder& SiteIndexBuilder::operator=(SiteIndexBuilder&&) noexcept = default;

void SiteIndexBuilder::Add(const Site& site) { AddSite(site, impl_->tables); }
void SiteIndexBuilder::Add(const SiteIndex& index) { AddSites(index.impl_->file, impl_->tables); }
void SiteIndexBuilder::Write(const std::string& path) const {
  WriteFileAtomically(path, SiteFileBytes(impl_->tables));
}

}  // namespace sslcd
