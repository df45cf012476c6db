// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/store/merge_maps.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "store/map_copy.h"
#include "store/merge_source.h"
#include "store_drive.h"

namespace sslcd {
namespace {

namespace fs = std::filesystem;

std::string BytesOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string ResultsOf(const std::string& path) {
  return TextOf(MapStore(path).Results(), Vec3(0, -1, 0));
}

// A map with sessions of these names, each the same street under another noise.
std::string MapOf(const std::string& path, const std::vector<std::string>& names, int seed = 1) {
  for (const std::string& name : names) {
    const StoreDrive drive = ShortStreet(30, seed++);
    MapSession session = BeginSession(path, name, drive);
    Finish(drive, session);
  }
  return path;
}

std::vector<std::string> NamesIn(const std::string& path) {
  std::vector<std::string> names;
  for (const SessionInfo& session : MapStore(path).Describe().sessions)
    names.push_back(session.name);
  return names;
}

using Names = std::vector<std::string>;

TEST(MergeMaps, SessionsAreAddedAsIfTheyHadBeenRecordedInTheMap) {
  const TempFolder folder;
  const std::string all = MapOf(folder.In("all.db"), {"one", "two", "three"});
  const std::string a = MapOf(folder.In("a.db"), {"one"});
  const std::string b = MapOf(folder.In("b.db"), {"two", "three"}, 2);
  const std::string before = BytesOf(a), from = BytesOf(b), out = folder.In("out.db");
  const MergeReport report = MergeMaps({a, {b}, out});
  EXPECT_EQ(BytesOf(a), before);
  EXPECT_EQ(BytesOf(b), from);
  MergeMaps({a, {b}});
  for (const std::string& merged : {out, a}) {
    EXPECT_EQ(ResultsOf(merged), ResultsOf(all));
    EXPECT_TRUE(MapStore(merged).Verify().empty());
    const MapInfo info = MapStore(merged).Describe(), whole = MapStore(all).Describe();
    ASSERT_EQ(info.sessions.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(info.sessions[i].checksum, whole.sessions[i].checksum);
      EXPECT_EQ(info.sessions[i].frame_offset, whole.sessions[i].frame_offset);
      EXPECT_EQ(info.sessions[i].dataset, "a drive");
    }
  }
  ASSERT_EQ(report.added.size(), 2u);
  EXPECT_EQ(report.added[1].name, "three");
  EXPECT_EQ(report.added[1].map, b);
  EXPECT_EQ(report.added[1].frames, 30);
  EXPECT_EQ(MapStore(a).Frames("three").size(), 30u);
  ExpectError([&] { MapStore(a).Frames("four"); }, {"no session 'four'", "map info"});
}

TEST(MergeMaps, RefinedOnceAllSessionsAreInOneMap) {
  const TempFolder folder;
  const std::string a = MapOf(folder.In("a.db"), {"one"});
  const std::string b = MapOf(folder.In("b.db"), {"two", "three"}, 2);
  const std::string out = folder.In("out.db");
  MergeRequest request{a, {b}, out};
  request.refine_once = true;
  MergeMaps(request);
  std::vector<int> refined;  // ids of the sessions
  for (const StoredInput& input : ReadMergeSource(out).inputs)
    if (input.kind == InputKind::kRefinement) refined.push_back(input.session);
  EXPECT_EQ(refined, (std::vector<int>{1, 3}));
  EXPECT_TRUE(MapStore(out).Verify().empty());
}

TEST(MergeMaps, SeveralMapsAtOnceAreTheSameAsOneByOne) {
  const TempFolder folder;
  const std::string a = MapOf(folder.In("a.db"), {"one"});
  const std::string b = MapOf(folder.In("b.db"), {"two"}, 2);
  const std::string c = MapOf(folder.In("c.db"), {"three"}, 3);
  MergeMaps({a, {b, c}, folder.In("out.db")});
  MergeMaps({a, {b}});
  MergeMaps({a, {c}});
  EXPECT_EQ(ResultsOf(a), ResultsOf(folder.In("out.db")));
}

// A process that ends in the middle of the work, at any frame, leaves the map as it was.
TEST(MergeMaps, AKilledMergeChangesNothing) {
  const TempFolder folder;
  const std::string a = MapOf(folder.In("a.db"), {"one"});
  const std::string b = MapOf(folder.In("b.db"), {"two"}, 2);
  const std::string before = BytesOf(a);
  for (const int end : {1, 17, 30}) {
    MergeRequest request{a, {b}};
    request.progress = [&](int done, int) { return done < end || raise(SIGKILL) != 0; };
    const pid_t child = fork();
    if (child == 0) {
      MergeMaps(request);
      _exit(0);
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFSIGNALED(status));
    EXPECT_TRUE(fs::exists(a + "-merge"));
    EXPECT_EQ(BytesOf(a), before);
    EXPECT_TRUE(MapStore(a).Verify().empty());
  }
  MergeMaps({a, {b}});
  EXPECT_EQ(NamesIn(a), (Names{"one", "two"}));
  for (const auto& entry : fs::directory_iterator(folder.path()))
    EXPECT_EQ(entry.path().extension(), ".db") << "nothing is left";
}

TEST(MergeMaps, AMergeCanBeStopped) {
  const TempFolder folder;
  const std::string a = MapOf(folder.In("a.db"), {"one"});
  const std::string b = MapOf(folder.In("b.db"), {"two"}, 2);
  const std::string before = BytesOf(a);
  MergeRequest request{a, {b}};
  int last = 0;
  request.progress = [&](int done, int total) {
    EXPECT_EQ(total, 30);
    last = done;
    return done < 20;
  };
  EXPECT_TRUE(MergeMaps(request).stopped);
  EXPECT_EQ(last, 20);
  EXPECT_EQ(BytesOf(a), before);
  EXPECT_FALSE(fs::exists(a + "-merge"));
}

TEST(MergeMaps, TakenNamesAreRefusedOrChanged) {
  const TempFolder folder;
  const std::string a = MapOf(folder.In("a.db"), {"one", "one-2"});
  const std::string b = MapOf(folder.In("b.db"), {"one", "other"}, 3);
  ExpectError([&] { MergeMaps({a, {b}}); }, {"a.db", "b.db", "'one' already", "--rename"});
  EXPECT_EQ(NamesIn(a).size(), 2u);
  MergeMaps({a, {b}, "", true});
  EXPECT_EQ(NamesIn(a), (Names{"one", "one-2", "one-3", "other"}));
  ExpectError(
      [&] {
        MergeMaps({a, {b}, "", true});
      },
      {"b.db: session 'one' is the same drive as session 'one-3' of", "leave this map out"});
}

TEST(MergeMaps, WhatDoesNotBelongTogetherIsRefused) {
  const TempFolder folder;
  const std::string a = MapOf(folder.In("a.db"), {"one"});
  const StoreDrive drive = ShortStreet(30, 2);
  const auto refused = [&](const std::string& name, const MapperContext& context,
                           const Options& options, const std::vector<std::string>& parts) {
    const std::string b = folder.In(name);
    MapSession::Begin(b, {"two"}, context, options).End();
    ExpectError([&] { MergeMaps({a, {b}}); }, parts);
  };
  MapperContext context = drive.Context();
  context.gravity = GravityFrame::FromUp(Vec3(0, 0, 1));
  refused("up.db", context, {}, {"up.db cannot be merged", "a.db: is the map of another site"});
  context = drive.Context();
  context.labels.Set("Pole", {Symmetry::kPi});
  refused("label.db", context, {}, {"label.db cannot be merged", "'Pole'", "'full' there"});
  Options options;
  options.window.keyframes = 5;
  refused("options.db", drive.Context(), options, {"options.db", "keyframes: 8", "keyframes: 5"});
  StoreDrive other = drive;
  for (Frame& frame : other.frames)
    for (Detection& detection : frame.detections) detection.appearance[Cue::kEmbedding] = {1, 0, 0};
  const std::string b = folder.In("length.db");
  {
    MapSession session = BeginSession(b, "two", other);
    Finish(other, session);
  }
  ExpectError([&] { MergeMaps({a, {b}}); }, {"length.db: its embedding vectors have 3", "a.db 2"});
  EXPECT_EQ(NamesIn(a), Names{"one"});
}

TEST(MergeMaps, FilesThatCannotBeMerged) {
  const TempFolder folder;
  const std::string a = MapOf(folder.In("a.db"), {"one"});
  const std::string b = MapOf(folder.In("b.db"), {"two"}, 2);
  ExpectError([&] { MergeMaps({a, {}}); }, {"at least two maps"});
  ExpectError([&] { MergeMaps({a, {folder.path() + "/./a.db"}}); }, {"with itself"});
  ExpectError([&] { MergeMaps({a, {folder.In("none.db")}}); }, {"none.db: no such map"});
  ExpectError([&] { MergeMaps({folder.In("none.db"), {b}}); }, {"none.db: no such map"});
  EXPECT_FALSE(fs::exists(folder.In("none.db-lock")));
  ExpectError([&] { MergeMaps({a, {b}, b}); }, {"b.db: exists"});
  std::ofstream(folder.In("text.db")) << std::string(5000, 'x');
  ExpectError([&] { MergeMaps({a, {folder.In("text.db")}}); }, {"not an SQLite file"});
  ExpectError([&] { MergeMaps({a, {b}, folder.In("no/out.db")}); }, {"folder"});
  EXPECT_EQ(NamesIn(a), Names{"one"});
}

// A map that has the name of the working copy would be removed.
TEST(MergeMaps, AMapWithTheNameOfTheWorkingCopyIsRefused) {
  const TempFolder folder;
  const std::string a = MapOf(folder.In("a.db"), {"one"});
  const std::string b = MapOf(folder.In("a.db-merge"), {"two"}, 2);
  ExpectError([&] { MergeMaps({a, {b}}); }, {"a.db-merge: the working copy", "rename"});
  const std::string c = MapOf(folder.In("c.db-merge"), {"three"}, 3);
  ExpectError([&] { MergeMaps({c, {a}, folder.In("c.db")}); }, {"c.db-merge: the working copy"});
  EXPECT_EQ(NamesIn(b), Names{"two"});
  EXPECT_EQ(NamesIn(c), Names{"three"});
}

// As on a full disk: SQLite could not move its log into the file.
TEST(MergeMaps, ACopyWithALogIsNotMoved) {
  const TempFolder folder;
  const std::string a = MapOf(folder.In("a.db"), {"one"}), out = folder.In("out.db");
  WorkingCopy copy(a, out);
  std::ofstream(copy.path() + "-wal") << "frames";
  ExpectError([&] { copy.MoveTo(out); }, {"out.db", "disk full", "try again"});
  EXPECT_FALSE(fs::exists(out));
  fs::resize_file(copy.path() + "-wal", 0);
  copy.MoveTo(out);
  EXPECT_EQ(NamesIn(out), Names{"one"});
}

TEST(MergeMaps, SessionsThatHaveNotEndedAreLeftOut) {
  const TempFolder folder;
  const std::string a = MapOf(folder.In("a.db"), {"one"});
  const std::string b = MapOf(folder.In("b.db"), {"two"}, 2);
  const StoreDrive drive = ShortStreet(30, 3);
  BeginSession(b, "open", drive).Save();
  const MergeReport report = MergeMaps({a, {b}, folder.In("out.db")});
  EXPECT_EQ(report.left_out, Names{b + ": open"});
  EXPECT_EQ(NamesIn(folder.In("out.db")), (Names{"one", "two"}));
  ExpectError([&] { MergeMaps({b, {a}}); }, {"b.db: session 'open' has not been ended"});
  const std::string c = folder.In("c.db");
  BeginSession(c, "open", drive).Save();
  ExpectError([&] { MergeMaps({a, {c}}); }, {"no session to add"});
}

// The stored answers of a view aligner take the place of its images.
TEST(MergeMaps, AlignedViewsAreTakenAlong) {
  const TempFolder folder;
  const std::string a = folder.In("a.db"), b = folder.In("b.db");
  Options options;  // cameras of one stretch of road see the same ground
  options.loop.views.gap_m = 5;
  options.loop.views.apart_m = 20;
  std::string whole;
  for (const std::string& name : Names{"one", "two"}) {
    const StoreDrive drive = ShortStreet(60, name == "one" ? 1 : 2);
    MapperContext context = drive.Context();
    context.view_aligner = OneByOne([&](const ViewPair& pair) {
      return std::optional<RelativePose>({pair.T_a_b_guess, Pose::Matrix6::Identity() * 1e-4});
    });
    MapSession session = MapSession::Begin(name == "one" ? a : b, {name}, context, options);
    Finish(drive, session);
  }
  MergeMaps({a, {b}});
  // its refinements name other frames now, and yet it is the same drive
  EXPECT_NE(MapStore(a).Describe().sessions[1].checksum,
            MapStore(b).Describe().sessions[0].checksum);
  ExpectError(
      [&] {
        MergeMaps({a, {b}, "", true});
      },
      {"b.db: session 'two' is the same drive as session 'two' of"});
  const auto ties = [](const std::string& path) {
    int count = 0;
    for (const PoseGraph::Edge& edge : MapStore(path).Results().graph.edges) count += edge.loop;
    return count;
  };
  EXPECT_TRUE(MapStore(a).Verify().empty());
  EXPECT_GE(ties(a), ties(b));
  // made again from its inputs, the merged map is the same
  const std::string merged = ResultsOf(a);
  MapSession session = MapSession::Begin(a, {"three"}, ShortStreet(30, 3).Context(), {});
  EXPECT_EQ(TextOf(session.mapper()), merged);
}

}  // namespace
}  // namespace sslcd
