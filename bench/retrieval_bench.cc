// SPDX-License-Identifier: BSD-3-Clause
// Which of many maps is a stretch of a drive from? (sslcd/retrieval/site_index.h)
//
//   retrieval_bench sites SITES QUERIES FILE   an index of generated sites (generated_sites.h), as
//     many of each kind, and stretches of 75 to 100 m through them. A row for each kind and noise:
//     queries; those whose site is the first, and among the first ten; those in which the true pose
//     beats all sites that were found ("oracle": what no search could better with this score);
//     objects of a stretch; median and p95 of the CPU time [ms]. A last row "file": sites, objects,
//     bytes an object, CPU time to build and to open it [s].
//   retrieval_bench real SITES SHARE STRETCH_M FILE DATA GROUNDTRUTH...   the same file with the
//     maps of the first SHARE of real drives. Each 25 m of the rest a stretch begins. A row for
//     each drive: landmarks; stretches that share six landmarks with the map, by true poses; those
//     whose drive is the first, and among the first ten; p95 of the CPU time [ms].
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <map>
#include <string>
#include <vector>

#include "generated_sites.h"
#include "judged_map.h"
#include "recorded_sessions.h"
#include "retrieval/site_fit.h"
#include "sslcd/core/error.h"
#include "sslcd/datasets/dataset.h"
#include "sslcd/pipeline/options.h"

namespace sslcd {
namespace {

constexpr int kFirst = 10;

double CpuSeconds() {
  timespec now = {};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double Quantile(std::vector<double> values, double share) {
  if (values.empty()) return -1;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

std::string KindOf(int site) { return kSiteKinds[site % kSiteKinds.size()]; }

void AddGenerated(int sites, SiteIndexBuilder& builder) {
  for (int i = 0; i < sites; ++i) {
    const auto seed = static_cast<std::uint64_t>(i);
    builder.Add(MapOfSite(MakeSite(KindOf(i), seed), KindOf(i) + " " + std::to_string(i), seed));
  }
}

struct Counts {
  int queries = 0, first = 0, ten = 0, oracle = 0;
  std::size_t objects = 0;
  std::vector<double> ms;
};

// Whether a pose from nowhere but the truth would have been the first.
bool OracleFinds(const SiteIndex& index, int site, const GeneratedStretch& stretch,
                 const std::vector<SiteCandidate>& found) {
  std::map<std::string, std::uint16_t> labels;
  const auto number = [&](const std::string& label) {
    return labels.insert({label, static_cast<std::uint16_t>(labels.size())}).first->second;
  };
  std::vector<SitePoint> points, map;
  double x = 0, y = 0;
  for (const SiteObject& object : stretch.objects)
    x += object.x / static_cast<double>(stretch.objects.size()),
        y += object.y / static_cast<double>(stretch.objects.size());
  for (const SiteObject& object : stretch.objects)
    points.push_back({static_cast<float>(object.x - x), static_cast<float>(object.y - y),
                      number(object.label), 0});
  for (const SiteObject& object : index.ReadSite(site).objects)
    map.push_back(
        {static_cast<float>(object.x), static_cast<float>(object.y), number(object.label), 0});
  const double c = std::cos(stretch.truth.yaw), s = std::sin(stretch.truth.yaw);
  const FlatPose pose{static_cast<float>(stretch.truth.yaw),
                      static_cast<float>(stretch.truth.x + c * x - s * y),
                      static_cast<float>(stretch.truth.y + s * x + c * y)};
  const double score = FitSite(points, {map.data(), map.data() + map.size()}, pose).score;
  return std::all_of(found.begin(), found.end(), [&](const SiteCandidate& other) {
    return other.site == site || other.score <= score;
  });
}

void Query(const SiteIndex& index, int site, const StretchNoise& noise, std::uint64_t seed,
           Counts& counts) {
  const GeneratedStretch stretch =
      DriveThrough(MakeSite(KindOf(site), static_cast<std::uint64_t>(site)), noise, seed);
  const double start = CpuSeconds();
  const std::vector<SiteCandidate> found = index.Find(stretch.objects, kFirst);
  counts.ms.push_back(1e3 * (CpuSeconds() - start));
  const auto place = std::find_if(found.begin(), found.end(),
                                  [&](const SiteCandidate& one) { return one.site == site; });
  ++counts.queries;
  counts.first += place == found.begin() && !found.empty();
  counts.ten += place != found.end();
  counts.oracle += OracleFinds(index, site, stretch, found);
  counts.objects += stretch.objects.size();
}

std::vector<StretchNoise> Noises() {
  StretchNoise low, usual, high;
  low = {"low", 0.2, 0.1, 0.1, 0.03, 0.01, 1e-4};
  usual.name = "usual";
  high = {"high", 0.5, 0.3, 0.2, 0.05, 0.03, 3e-4};
  return {low, usual, high};
}

void RunGenerated(int sites, int queries, const std::string& file) {
  SiteIndexBuilder builder;
  AddGenerated(sites, builder);
  double start = CpuSeconds();
  builder.Write(file);
  const double build_s = CpuSeconds() - start;
  builder = SiteIndexBuilder();
  start = CpuSeconds();
  const SiteIndex index(file);
  const double open_s = CpuSeconds() - start;
  std::printf("run,queries,first,ten,oracle,objects,median ms,p95 ms\n");
  const int kinds = static_cast<int>(kSiteKinds.size());
  for (int kind = 0; kind < std::min(kinds, sites); ++kind)
    for (const StretchNoise& noise : Noises()) {
      Counts counts;
      for (int i = 0; i < queries; ++i) {
        const int of_kind = (sites - kind + kinds - 1) / kinds;
        const int site = kind + kinds * static_cast<int>(i * 7919LL % of_kind);
        Query(index, site, noise, 1000000 + static_cast<std::uint64_t>(i), counts);
      }
      std::printf("%s %s,%d,%d,%d,%d,%zu,%.1f,%.1f\n", kSiteKinds[kind].c_str(), noise.name.c_str(),
                  counts.queries, counts.first, counts.ten, counts.oracle,
                  counts.objects / static_cast<std::size_t>(queries), Quantile(counts.ms, .5),
                  Quantile(counts.ms, .95));
      std::fflush(stdout);
    }
  std::printf("file,%d,%lld,%.1f,%.1f,%.2f,,\n", index.size(),
              static_cast<long long>(index.objects()),
              static_cast<double>(index.file_bytes()) / static_cast<double>(index.objects()),
              build_s, open_s);
}

// The landmarks of a stretch.
std::vector<SiteObject> MappedAlong(const Session& stretch, const MapperContext& context) {
  Options options = DefaultOptions(Mode::kRobust);
  options.loop.enabled = false;
  Mapper mapper(options, context);
  for (const Frame& frame : stretch.frames) mapper.AddFrame(frame);
  return SiteObjectsOf(mapper.Objects(), context.gravity);
}

struct RealDrive {
  std::string name;
  Session drive;
  MapperContext context;
  std::size_t end = 0;  // of the mapped part
  JudgedMap map;
};

void Judge(const RealDrive& of, double stretch_m, const SiteIndex& index, int site) {
  constexpr double kEvery = 25;  // [m]
  constexpr int kShared = 6;
  const std::vector<double> path_m = PathOf(of.drive);
  const auto frame_at = [&](double m) {
    return static_cast<std::size_t>(std::lower_bound(path_m.begin(), path_m.end(), m) -
                                    path_m.begin());
  };
  Counts counts;
  for (double m = path_m[of.end]; m + stretch_m <= path_m.back(); m += kEvery) {
    const Session stretch =
        Cut(of.drive, frame_at(m), frame_at(m + stretch_m), 1, of.context.gravity.up);
    if (Shared(of.map, stretch) < kShared) continue;
    const std::vector<SiteObject> objects = MappedAlong(stretch, of.context);
    const double start = CpuSeconds();
    const std::vector<SiteCandidate> found = index.Find(objects, kFirst);
    counts.ms.push_back(1e3 * (CpuSeconds() - start));
    ++counts.queries;
    counts.objects += objects.size();
    counts.first += !found.empty() && found[0].site == site;
    counts.ten += std::any_of(found.begin(), found.end(),
                              [&](const SiteCandidate& one) { return one.site == site; });
  }
  std::printf("%s,%zu,%d,%d,%d,%zu,%.1f\n", of.name.c_str(), of.map.reference.objects.size(),
              counts.queries, counts.first, counts.ten,
              counts.objects / static_cast<std::size_t>(std::max(counts.queries, 1)),
              Quantile(counts.ms, .95));
  std::fflush(stdout);
}

RealDrive ReadDrive(const std::string& folder, const std::string& truth, double share) {
  DatasetRequest request;
  request.path = folder;
  request.groundtruth = truth;
  const Dataset data = LoadDataset(request);
  RealDrive of{folder, WithTruth(data), {}, 0, {}};
  of.context.gravity = GravityFrame::FromUp(data.up_axis);
  of.context.labels = data.labels;
  of.context.camera = data.camera;
  const std::vector<double> path_m = PathOf(of.drive);
  of.end = static_cast<std::size_t>(
      std::lower_bound(path_m.begin(), path_m.end(), share * path_m.back()) - path_m.begin());
  of.map = MapOf({Cut(of.drive, 0, of.end, 0, of.context.gravity.up)}, of.context);
  return of;
}

void RunReal(int sites, double share, double stretch_m, const std::string& file, char** drives,
             int count) {
  SiteIndexBuilder builder;
  AddGenerated(sites, builder);
  std::vector<RealDrive> all;
  for (int i = 0; i + 1 < count; i += 2) {
    all.push_back(ReadDrive(drives[i], drives[i + 1], share));
    builder.Add(Site{all.back().name, SiteObjectsOf(all.back().map.reference)});
  }
  builder.Write(file);
  const SiteIndex index(file);
  std::printf("run,landmarks,stretches,first,ten,objects,p95 ms\n");
  for (std::size_t i = 0; i < all.size(); ++i)
    Judge(all[i], stretch_m, index, sites + static_cast<int>(i));
}

int Main(int argc, char** argv) {
  const std::string mode = argc > 1 ? argv[1] : "";
  if (mode == "sites" && argc == 5) {
    RunGenerated(std::atoi(argv[2]), std::atoi(argv[3]), argv[4]);
  } else if (mode == "real" && argc >= 8) {
    RunReal(std::atoi(argv[2]), std::atof(argv[3]), std::atof(argv[4]), argv[5], argv + 6,
            argc - 6);
  } else {
    std::fprintf(stderr,
                 "usage: retrieval_bench sites SITES QUERIES FILE\n"
                 "       retrieval_bench real SITES SHARE STRETCH_M FILE DATA GROUNDTRUTH...\n");
    return 2;
  }
  return 0;
}

}  // namespace
}  // namespace sslcd

int main(int argc, char** argv) {
  try {
    return sslcd::Main(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 1;
  }
}
