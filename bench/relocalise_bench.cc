// SPDX-License-Identifier: BSD-3-Clause
// Drives that are found in a map of an earlier one, without any prior pose (pipeline/localiser.h).
//
//   relocalise_bench DATA GROUNDTRUTH SHARE STRETCH_M   the map: the first SHARE of the path. Each
//     25 m of the rest a stretch of this length begins, whose odometry starts at its own origin.
//   relocalise_bench halv|copy CASE LAYOUT FIRST_SEED LAST_SEED [CHURN]   HALV-sim, recorded twice;
//     the map is that of the first session, with `copy` also that of a copy of the site, in one
//     file. The stretch is the whole way back.
//
// Prints a CSV row for a drive, or for each seed: landmarks of the map; stretches; those that share
// six landmarks with the map or more, by true poses, and how many of them are found; those that
// share none, and how many of them are found, which is wrong; wrong answers (off by 5 m or 10
// degrees, or in the copy) of all attempts; median path to the first answer, its largest value, and
// the share of stretches found within 50 m; median error of the first answers; p95 of the time of
// an attempt.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "judged_map.h"
#include "recorded_sessions.h"
#include "sslcd/core/error.h"
#include "sslcd/datasets/dataset.h"
#include "sslcd/pipeline/localiser.h"
#include "sslcd/pipeline/options.h"

namespace sslcd {
namespace {

constexpr double kWrongM = 5, kWrongRad = M_PI / 18;
constexpr int kShared = 6;

struct Figures {
  int stretches = 0, sharing = 0, sharing_found = 0, elsewhere = 0, elsewhere_found = 0;
  int wrong = 0, within_50_m = 0;
  std::vector<double> path_m, error_m, ms;
};

double Quantile(std::vector<double> values, double share) {
  if (values.empty()) return -1;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

// How far an answer is off: [m, rad]; infinite in a copy.
std::pair<double, double> ErrorOf(const JudgedMap& map, const Pose& T_map_cam, const Pose& truth) {
  const MapCamera& near = map.Nearest([&](const MapCamera& camera) {
    return (camera.T_map_cam.translation() - T_map_cam.translation()).norm();
  });
  if (near.copy) return {std::numeric_limits<double>::infinity(), 0};
  const Pose error =
      (near.T_map_cam.inverse() * T_map_cam).inverse() * (near.truth.inverse() * truth);
  return {error.translation().norm(), error.so3().Log().norm()};
}

void Locate(const JudgedMap& map, const Session& stretch, const std::optional<Camera>& camera,
            Figures& figures) {
  Localiser localiser(map.reference, DefaultOptions(Mode::kRobust), camera);
  double first_m = -1;
  for (std::size_t i = 0; i < stretch.frames.size(); ++i) {
    const auto start = std::chrono::steady_clock::now();
    const std::optional<Localisation> answer = localiser.AddFrame(stretch.frames[i]);
    if (!answer) continue;
    figures.ms.push_back(
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
            .count());
    if (answer->decision != LoopDecision::kAccepted) continue;
    const auto [metres, rad] = ErrorOf(map, answer->T_map_cam, stretch.truth[i]);
    if (metres > kWrongM || rad > kWrongRad) ++figures.wrong;
    if (first_m >= 0) continue;
    first_m = answer->travelled_m;
    figures.path_m.push_back(first_m);
    figures.error_m.push_back(metres);
  }
  const int shared = Shared(map, stretch);
  const bool found = first_m >= 0;
  ++figures.stretches;
  figures.sharing += shared >= kShared;
  figures.sharing_found += shared >= kShared && found;
  figures.elsewhere += shared == 0;
  figures.elsewhere_found += shared == 0 && found;
  figures.within_50_m += found && first_m <= 50;
}

void Print(const std::string& name, const JudgedMap& map, const Figures& f) {
  std::printf("%s,%zu,%d,%d,%d,%d,%d,%d,%.0f,%.0f,%d,%.2f,%.1f\n", name.c_str(),
              map.reference.objects.size(), f.stretches, f.sharing, f.sharing_found, f.elsewhere,
              f.elsewhere_found, f.wrong, Quantile(f.path_m, .5), Quantile(f.path_m, 1),
              f.within_50_m, Quantile(f.error_m, .5), Quantile(f.ms, .95));
  std::fflush(stdout);
}

void RunDrive(const DatasetRequest& request, double share, double stretch_m) {
  constexpr double kEvery = 25;  // [m]
  const Dataset data = LoadDataset(request);
  const Session drive = WithTruth(data);
  MapperContext context;
  context.gravity = GravityFrame::FromUp(data.up_axis);
  context.labels = data.labels;
  context.camera = data.camera;
  const std::vector<double> path_m = PathOf(drive);
  const auto frame_at = [&](double m) {
    return static_cast<std::size_t>(std::lower_bound(path_m.begin(), path_m.end(), m) -
                                    path_m.begin());
  };
  const double end_m = share * path_m.back();
  const JudgedMap map = MapOf({Cut(drive, 0, frame_at(end_m), 0, context.gravity.up)}, context);
  Figures figures;
  for (double m = end_m; m + stretch_m <= path_m.back(); m += kEvery)
    Locate(map, Cut(drive, frame_at(m), frame_at(m + stretch_m), 1, context.gravity.up),
           data.camera, figures);
  Print(data.name, map, figures);
}

void RunHalv(bool copy, int halv_case, const std::string& layout, int first, int last,
             double churn) {
  for (int seed = first; seed <= last; ++seed) {
    const TwoVisits visits =
        RecordHalvTwice(halv_case, layout, static_cast<std::uint64_t>(seed), churn);
    std::vector<Session> sessions = {visits.first};
    if (copy) sessions.push_back(visits.copy);
    const JudgedMap map = MapOf(sessions, {visits.gravity, visits.labels, visits.camera});
    Figures figures;
    Locate(map, visits.second, visits.camera, figures);
    Print(layout + " " + std::to_string(halv_case) + " seed " + std::to_string(seed), map, figures);
  }
}

int Main(int argc, char** argv) {
  const bool halv = argc >= 6 && (!std::strcmp(argv[1], "halv") || !std::strcmp(argv[1], "copy"));
  if (!halv && argc != 5) {
    std::fprintf(stderr,
                 "usage: relocalise_bench DATA GROUNDTRUTH SHARE STRETCH_M\n"
                 "       relocalise_bench halv|copy CASE LAYOUT FIRST_SEED LAST_SEED [CHURN]\n");
    return 2;
  }
  std::printf(
      "run,landmarks,stretches,sharing,found,elsewhere,found elsewhere,wrong,path m,"
      "longest path m,within 50 m,error m,p95 ms\n");
  if (halv) {
    RunHalv(argv[1][0] == 'c', std::atoi(argv[2]), argv[3], std::atoi(argv[4]), std::atoi(argv[5]),
            argc > 6 ? std::atof(argv[6]) : 0.3);
    return 0;
  }
  DatasetRequest request;
  request.path = argv[1];
  request.groundtruth = argv[2];
  RunDrive(request, std::atof(argv[3]), std::atof(argv[4]));
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
