// SPDX-License-Identifier: BSD-3-Clause
#include "map_files.h"

#include <filesystem>
#include <map>

#include "formats/file_set.h"
#include "formats/files.h"
#include "formats/map_json.h"
#include "sslcd/core/error.h"
#include "sslcd/store/map_store.h"

namespace sslcd::apps {
namespace {

namespace fs = std::filesystem;

bool EndsWith(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

}  // namespace

std::vector<std::string> MapFiles(const std::string& path) {
  if (!IsFolder(path)) return {path};
  const auto in = [&](const std::string& name) { return (fs::path(path) / name).string(); };
  if (IsFile(in("map.json"))) return {in("map.json")};
  std::vector<std::string> files;
  for (const std::string& name : FileNames(path)) {
    if (EndsWith(name, ".db") && IsFile(in(name))) files.push_back(in(name));
    const std::string of_run = (fs::path(in(name)) / "map.json").string();
    if (IsFolder(in(name)) && IsFile(of_run)) files.push_back(of_run);
  }
  if (files.empty())
    throw Error(ErrorKind::kBadInput,
                path + ": has no *.db, no map.json and no run folder; name the maps");
  return files;
}

void RefuseTwice(const std::vector<std::string>& files) {
  std::map<std::string, std::string> seen;  // by the path without links and dots
  for (const std::string& file : files) {
    std::error_code ignored;
    const auto [first, fresh] = seen.insert({fs::weakly_canonical(file, ignored).string(), file});
    if (!fresh)
      throw Error(ErrorKind::kUsage,
                  file + ": is named twice" +
                      (first->second == file ? "" : ", also as " + first->second) +
                      "; name each map once");
  }
}

Site ReadMapFile(const std::string& file) {
  if (EndsWith(file, ".json")) {
    RefuseUnfinished(fs::absolute(file).parent_path().string());
    const MapFile map = ReadMapJson(file);
    return {file, SiteObjectsOf(map.objects, GravityFrame::FromUp(map.up_axis))};
  }
  const MapStore store(file);
  return {file,
          SiteObjectsOf(store.Results().objects, GravityFrame::FromUp(store.Describe().up_axis))};
}

}  // namespace sslcd::apps
