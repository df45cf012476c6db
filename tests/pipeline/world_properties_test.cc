// SPDX-License-Identifier: BSD-3-Clause
// Changes of the input that change no result, or little, on generated drives (docs/properties.md).
// `scripts/measure.sh --only properties` runs them for many drives:
//   SSLCD_PROPERTY_SEEDS=20   number of drives (default 1)
//   SSLCD_PROPERTY_DATA=A:B   sequence folders instead, with groundtruth.txt or reference.txt
//   SSLCD_PROPERTY_ROWS=FILE  a CSV row for each property and drive is added to it
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "changed_drives.h"
#include "same_mappers.h"
#include "sslcd/datasets/dataset.h"

namespace sslcd {
namespace {

std::string Variable(const char* name, const char* otherwise) {
  const char* value = std::getenv(name);
  return value ? value : otherwise;
}

Drive RealDrive(const std::string& folder) {
  DatasetRequest request;
  request.path = folder;
  const bool reference = std::filesystem::exists(folder + "/reference.txt");
  request.groundtruth = reference ? "reference.txt" : "groundtruth.txt";
  const Dataset data = LoadDataset(request);
  return {data.frames,
          {GravityFrame::FromUp(data.up_axis), data.labels, data.camera},
          data.groundtruth->poses};
}

struct Named {
  std::string name;
  std::uint64_t seed = 0;
  Drive drive;
  Outcome outcome;
};

// The drives of this call with their unchanged outcomes, made once.
const std::vector<Named>& Drives() {
  static const std::vector<Named> drives = [] {
    std::vector<Named> made;
    std::stringstream folders(Variable("SSLCD_PROPERTY_DATA", ""));
    for (std::string folder; std::getline(folders, folder, ':');)
      made.push_back({folder, made.size(), RealDrive(folder), {}});
    const int seeds = std::stoi(Variable("SSLCD_PROPERTY_SEEDS", "1"));
    for (int seed = 0; made.size() < static_cast<std::size_t>(seeds); ++seed)
      made.push_back({"HALV-sim " + std::to_string(4 - seed % 4) + "/" + std::to_string(500 + seed),
                      500u + static_cast<std::uint64_t>(seed),
                      HalvDrive(4 - seed % 4, 500u + static_cast<std::uint64_t>(seed)),
                      {}});
    for (Named& one : made) one.outcome = RunAndJudge(one.drive);
    return made;
  }();
  return drives;
}

void Write(const std::string& property, const Named& one, const Outcome& changed,
           const Difference& difference) {
  const std::string path = Variable("SSLCD_PROPERTY_ROWS", "");
  if (path.empty()) return;
  std::ofstream(path, std::ios::app)
      << property << ',' << one.name << ',' << difference.loops << ',' << difference.loops_changed
      << ',' << difference.in_common << ',' << one.outcome.wrong << ',' << changed.wrong << ','
      << one.outcome.ate_m << ',' << changed.ate_m << ',' << difference.farthest_m << ','
      << difference.farthest_loop_m << '\n';
}

// What is left of 1e-9 m, the last digit of coordinates of 5000 km, after a run. [m]
constexpr double kRounding = 1e-6;

using Change = std::function<std::pair<Drive, Pose>(const Named&)>;  // drive and T_new_old

std::vector<std::pair<Outcome, Difference>> Apply(const std::string& property,
                                                  const Change& change) {
  std::vector<std::pair<Outcome, Difference>> found;
  for (const Named& one : Drives()) {
    const auto [drive, T_new_old] = change(one);
    const Outcome changed = RunAndJudge(drive);
    const Difference difference = Compare(one.outcome, changed, T_new_old.inverse());
    Write(property, one, changed, difference);
    found.push_back({changed, difference});
  }
  return found;
}

void ExpectSameResults(const std::string& property, double tolerance_m, const Change& change) {
  const auto found = Apply(property, change);
  for (std::size_t i = 0; i < found.size(); ++i) {
    SCOPED_TRACE(property + ", " + Drives()[i].name);
    const Difference& difference = found[i].second;
    EXPECT_EQ(difference.in_common, difference.loops);
    EXPECT_EQ(difference.loops_changed, difference.loops);
    EXPECT_LE(difference.farthest_m, tolerance_m);
    EXPECT_LE(difference.farthest_loop_m, tolerance_m);
    EXPECT_EQ(found[i].first.landmarks, Drives()[i].outcome.landmarks);
  }
}

Pose Turned(std::uint64_t seed, double reach_m) {
  sim::Random random(seed, 23);
  const auto any = [&] { return Vec3(random.Normal(), random.Normal(), random.Normal()); };
  const Vec3 axis = any().normalized(), to = reach_m * any();
  return Pose(lie::SO3<double>::Exp(Vec3(random.Uniform(0.5, 3) * axis)), to);
}

std::pair<Drive, Pose> MovedBy(const Named& one, const Pose& T_new_old) {
  return {Moved(one.drive, T_new_old), T_new_old};
}

TEST(WorldProperties, AnyRigidMotionOfTheWorldChangesNothing) {
  ExpectSameResults("turned about any axis and shifted", kRounding,
                    [](const Named& one) { return MovedBy(one, Turned(one.seed, 300)); });
}

TEST(WorldProperties, CoordinatesOfAMapGridChangeNothing) {
  ExpectSameResults("shifted by 5000 km", kRounding, [](const Named& one) {
    return MovedBy(one, Pose(lie::SO3<double>(), Vec3(4.5e5, 120, 5.4e6)));
  });
}

TEST(WorldProperties, TheOrderOfDetectionsChangesNothing) {
  ExpectSameResults("detections shuffled", kRounding, [](const Named& one) {
    return std::pair(Shuffled(one.drive, one.seed), Pose());
  });
}

TEST(WorldProperties, NamesOfLabelsChangeNothing) {
  ExpectSameResults("labels renamed", kRounding,
                    [](const Named& one) { return std::pair(Renamed(one.drive), Pose()); });
}

TEST(WorldProperties, TheOriginOfTimeChangesNothing) {
  ExpectSameResults("stamps 1.7e9 s later", kRounding, [](const Named& one) {
    return std::pair(WithStampsLater(one.drive, 1.7e9), Pose());
  });
}

// Fewer frames are another run: most of the loops, of a hundred at most one wrong, and better than
// odometry.
void ExpectNearlyAsGood(const std::string& property, const Change& change) {
  const auto found = Apply(property, change);
  int wrong = 0, loops = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    SCOPED_TRACE(property + ", " + Drives()[i].name);
    const Outcome &before = Drives()[i].outcome, &after = found[i].first;
    wrong += after.wrong;
    loops += static_cast<int>(after.loops.size());
    EXPECT_LE(after.ate_m, after.odometry_ate_m);
    EXPECT_GE(3 * after.loops.size(), 2 * before.loops.size());
  }
  EXPECT_LE(100 * wrong, loops);
}

TEST(WorldProperties, LostFramesCostLittle) {
  ExpectNearlyAsGood("one frame of ten lost", [](const Named& one) {
    return std::pair(WithoutSome(one.drive, 0.1, one.seed), Pose());
  });
}

TEST(WorldProperties, HalfTheFrameRateCostsLittle) {
  ExpectNearlyAsGood("every other frame",
                     [](const Named& one) { return std::pair(EveryOther(one.drive), Pose()); });
}

void AddAll(const Drive& drive, Mapper& mapper) {
  for (const Frame& frame : drive.frames) mapper.AddFrame(frame);
  mapper.Refine();
}

// Two mappers share nothing: not in turn, and not in two threads.
TEST(WorldProperties, MappersDoNotDisturbEachOther) {
  for (const Named& one : Drives()) {
    SCOPED_TRACE(one.name);
    const Drive other = Moved(one.drive, Turned(one.seed, 300));
    Mapper a({}, one.drive.context), b({}, other.context);
    for (std::size_t i = 0; i < one.drive.frames.size(); ++i) {
      a.AddFrame(one.drive.frames[i]);
      b.AddFrame(other.frames[i]);
    }
    a.Refine();
    b.Refine();
    Mapper c({}, one.drive.context), d({}, other.context);
    std::thread thread([&] { AddAll(one.drive, c); });
    AddAll(other, d);
    thread.join();
    ExpectSame(a, c);
    ExpectSame(b, d);
    std::size_t at = 0;
    for (const auto& [frame, T_world_cam] : one.outcome.poses)  // those of a mapper alone
      ASSERT_EQ(a.CameraTrajectory().poses[at++].matrix(), T_world_cam.matrix()) << frame;
  }
}

}  // namespace
}  // namespace sslcd
