// SPDX-License-Identifier: BSD-3-Clause
// What can happen to the file of a map.
#include "sslcd/store/map_store.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "sim/random.h"
#include "store/bytes.h"
#include "store/checksums.h"
#include "store/frame_bytes.h"
#include "store/schema.h"
#include "store/writable_map.h"
#include "store_drive.h"

namespace sslcd {
namespace {

namespace fs = std::filesystem;

std::string Content(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// Empty: sound. A file that cannot be opened has a problem, too.
std::string FirstProblem(const std::string& path) {
  try {
    const std::vector<std::string> problems = MapStore(path).Verify();
    return problems.empty() ? "" : problems.front();
  } catch (const Error& error) {
    return error.what();
  }
}

// Every change of a value is noticed, in every table.
TEST(MapStore, AChangedValueIsNoticed) {
  const TempFolder folder;
  const std::string path = MakeMap(folder, ShortStreet(30));
  const std::string copy = folder.In("copy.db");
  for (const char* change :
       {"UPDATE site SET up_x = 0.1", "UPDATE label SET symmetry = 'pi' WHERE name = 'Car'",
        "UPDATE cue SET length = 3", "UPDATE session SET name = 'x'",
        "UPDATE session SET inputs = 3", "UPDATE input SET content = x'00' WHERE id = 9",
        "UPDATE input SET kind = 'sequence' WHERE id = 9", "DELETE FROM input WHERE id = 31",
        "UPDATE result SET scale = 2", "UPDATE pose SET x = x + 1e-12 WHERE frame = 3",
        "UPDATE landmark SET state = 'stale' WHERE id = (SELECT min(id) FROM landmark)",
        "DELETE FROM sighting WHERE position = 0", "UPDATE edge SET loop = 1 WHERE id = 2",
        "DELETE FROM checksum WHERE name = 'edge'", "DROP TABLE loop_pair",
        "CREATE TABLE more (a)"}) {
    fs::copy_file(path, copy, fs::copy_options::overwrite_existing);
    ASSERT_EQ(FirstProblem(copy), "");
    { Database(copy, Database::Access::kWrite).Execute(change); }
    EXPECT_NE(FirstProblem(copy), "") << change;
    EXPECT_THROW(MapSession::Resume(copy, ShortStreet(30).Context()), Error) << change;
  }
}

// A bit that flips is noticed, or changes nothing that a reader is given.
TEST(MapStore, AFlippedBitIsNoticed) {
  const TempFolder folder;
  const std::string path = MakeMap(folder, ShortStreet(30));
  const std::string content = Content(path);
  const std::string sound = TextOf(MapStore(path).Results(), Vec3(0, -1, 0));
  sim::Random random(3);
  int noticed = 0;
  constexpr int kTries = 150;
  for (int i = 0; i < kTries; ++i) {
    std::string flipped = content;
    const auto place = static_cast<std::size_t>(random.Uniform(0, 1) * (content.size() - 1));
    flipped[place] =
        static_cast<char>(flipped[place] ^ (1 << static_cast<int>(random.Uniform(0, 8))));
    const std::string problem = FirstProblem(folder.Write("flipped.db", flipped));
    noticed += problem.empty() ? 0 : 1;
    if (problem.empty()) {
      EXPECT_EQ(TextOf(MapStore(folder.In("flipped.db")).Results(), Vec3(0, -1, 0)), sound)
          << place;
    }
  }
  EXPECT_GT(noticed, kTries / 3) << "the rest is unused space";
}

// What does not fit together, with checksums that do: no answer, or an Error.
TEST(MapStore, RowsThatDoNotFitTogetherAreRefused) {
  const TempFolder folder;
  const std::string path = MakeMap(folder, ShortStreet(30));
  const std::string copy = folder.In("copy.db");
  for (const char* change :
       {"UPDATE input SET content = CAST(x'ffffff7f' || substr(content, 5) AS BLOB) WHERE id = 9",
        "UPDATE input SET content = CAST(x'ffffffff' || substr(content, 5) AS BLOB) WHERE id = 9",
        "DELETE FROM input WHERE id = 9", "UPDATE session SET frame_offset = 2147483647",
        "UPDATE session SET frame_offset = 4294967297",
        "UPDATE pose SET frame = 4294967296 + frame WHERE frame = 29",
        "UPDATE pose SET x = 9e999 WHERE frame = 3", "UPDATE pose SET qw = 5 WHERE frame = 3",
        "UPDATE landmark SET length = -9e999", "UPDATE result SET scale = 9e999",
        "UPDATE input SET content = substr(content, 1, 20) WHERE id = 9",
        "UPDATE site SET up_x = 9e999"}) {
    fs::copy_file(path, copy, fs::copy_options::overwrite_existing);
    {
      Database map(copy, Database::Access::kWrite);
      map.Execute(std::string("PRAGMA foreign_keys = OFF;") + change);
      for (const auto* tables : {&kSiteTables, &kResultTables}) UpdateChecksums(map, *tables);
    }
    SCOPED_TRACE(change);
    ExpectError([&] { MapStore(copy).Results(); }, {copy});
    const std::string problem = FirstProblem(copy);
    EXPECT_NE(problem, "");
    EXPECT_EQ(problem.find("is damaged"), std::string::npos)
        << "said once, by the command: " << problem;
  }
}

TEST(MapStore, AReaderSeesOneStateBesideAWriter) {
  const TempFolder folder;
  const StoreDrive drive = ShortStreet();
  const std::string path = folder.In("site.db");
  MapSession session = BeginSession(path, "one", drive);
  const MapStore reader(path);
  int seen = 0;
  for (const Frame& frame : drive.frames) {
    session.AddFrame(frame);
    const MapInfo info = reader.Describe();
    EXPECT_EQ(info.sessions[0].frames, session.stored_frames());
    seen = info.sessions[0].frames;
  }
  EXPECT_GT(seen, 40);
  EXPECT_TRUE(reader.Verify().empty());
  EXPECT_TRUE(reader.Results().paths.empty()) << "no results yet";
  session.End();
  EXPECT_EQ(reader.Results().paths[0].frames.size(), 60u);
}

TEST(MapStore, TheAppearanceOfALandmarkIsTheMeanOfItsSightings) {
  const TempFolder folder;
  StoreDrive drive = ShortStreet(30);
  for (Frame& frame : drive.frames)
    for (Detection& detection : frame.detections)
      detection.appearance[Cue::kEmbedding] =
          frame.index % 2 == 0 ? std::vector<float>{1, 0} : std::vector<float>{0, 1};
  const std::string path = MakeMap(folder, drive);
  int even = 0, all = 0, id = -1;
  for (const MapObject& object : MapStore(path).Results().objects) {
    if (object.state != LandmarkState::kConfirmed || object.observations.size() < 5) continue;
    id = object.id.value;
    for (const Observation& seen : object.observations) even += seen.frame % 2 == 0 ? 1 : 0;
    all = static_cast<int>(object.observations.size());
    break;
  }
  ASSERT_GE(id, 0);
  Database database(path, Database::Access::kRead);
  Statement row(database, "SELECT cue, sightings, vector FROM appearance WHERE landmark = ?");
  ASSERT_TRUE(row.Bind(id).Step());
  EXPECT_EQ(row.Text(0), "embedding");
  EXPECT_EQ(row.Int(1), all);
  const std::string vector = row.Blob(2);
  ByteReader bytes(vector);
  const double length = std::hypot(even, all - even);
  EXPECT_FLOAT_EQ(bytes.Float(), static_cast<float>(even / length));
  EXPECT_FLOAT_EQ(bytes.Float(), static_cast<float>((all - even) / length));
  bytes.ExpectEnd();
  EXPECT_FALSE(row.Step()) << "there is no colour";
}

TEST(MapStore, AReaderLeavesNothingBehind) {
  const TempFolder folder;
  const std::string path = MakeMap(folder, ShortStreet(30));
  const std::string before = Content(path);
  { MapStore(path).Results(); }
  EXPECT_EQ(Content(path), before);
  for (const char* ending : {"-wal", "-shm", "-lock"}) EXPECT_FALSE(fs::exists(path + ending));
  Database reader(path, Database::Access::kRead);
  EXPECT_THROW(reader.Execute("DELETE FROM edge"), Error);
}

TEST(MapStore, TheSecondWriterIsToldWhoIsTheFirst) {
  const TempFolder folder;
  const StoreDrive drive = ShortStreet(30);
  const std::string path = folder.In("site.db");
  {
    const MapSession session = BeginSession(path, "one", drive);
    const std::string holder = "written by process " + std::to_string(getpid()) + " on ";
    ExpectError([&] { BeginSession(path, "two", drive); }, {path, holder, " since 20"});
    ExpectError([&] { CompactMap(path); }, {holder});
    EXPECT_TRUE(MapStore(path).Verify().empty());
  }
  EXPECT_FALSE(fs::exists(path + "-lock"));
}

TEST(MapStore, ALockEndsWithItsProcess) {
  const TempFolder folder;
  const StoreDrive drive = ShortStreet(30);
  const std::string path = folder.In("site.db");
  const pid_t child = fork();
  if (child == 0) {
    MapSession session = BeginSession(path, "one", drive);
    for (const Frame& frame : drive.frames) session.AddFrame(frame);
    _exit(session.stored_frames() > 0 ? 0 : 1);  // without any clean-up
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_EQ(status, 0);
  EXPECT_TRUE(fs::exists(path + "-lock"));
  MapSession session = MapSession::Resume(path, drive.Context());
  EXPECT_GT(session.stored_frames(), 0);
  Finish(drive, session);
  EXPECT_TRUE(MapStore(path).Verify().empty());
}

TEST(MapStore, AFullDiskLosesNothing) {
  const TempFolder folder;
  const std::string path = MakeMap(folder, ShortStreet(30));
  WritableMap map(path, Database::Access::kWrite);
  const std::int64_t pages = map.database.Integer("PRAGMA page_count");
  map.database.Execute("PRAGMA max_page_count = " + std::to_string(pages + 1));
  SessionInfo session = map.info.sessions.back();
  Frame frame;
  frame.index = 30;
  frame.detections.resize(1000);
  const StoredInput input{session.id, InputKind::kFrame, FrameBytes(frame)};
  const std::vector<StoredInput> inputs{input};
  session.checksum = NextChecksum(session.checksum, input.kind, input.content);
  ++session.inputs;
  const auto store = [&] { StoreBatch(map, {&inputs, &session, {}, {}, nullptr}); };
  ExpectError(store, {path, "full", "make room"});
  EXPECT_TRUE(MapStore(path).Verify().empty());
  EXPECT_EQ(MapStore(path).Describe().sessions[0].frames, 30);
  map.database.Execute("PRAGMA max_page_count = " + std::to_string(pages + 100));
  store();
  EXPECT_TRUE(MapStore(path).Verify().empty());
}

TEST(MapStore, TellsWhatWasThereWhen) {
  const TempFolder folder;
  const StoreDrive drive = ShortStreet(100);
  const std::string path = MakeMap(folder, drive);
  MapSession again = BeginSession(path, "two", drive);
  Finish(drive, again);
  const MapHistory history = MapStore(path).History();
  ASSERT_GT(history.places().size(), 10u);
  for (std::size_t i = 0; i < history.places().size(); ++i) {
    const PlaceHistory& place = history.places()[i];
    ASSERT_EQ(place.sessions.size(), 2u);
    EXPECT_NEAR(place.sessions[0].seen, place.sessions[1].seen, 3) << "the same detections";
    EXPECT_GT(place.sessions[1].probability, 0.9);
    EXPECT_GT(history.Between(static_cast<int>(i), 0, 1).stayed, 0.9);
  }
  Database(path, Database::Access::kWrite).Execute("UPDATE landmark SET x = x + 1");
  ExpectError([&] { MapStore(path).History(); }, {path, "is damaged"});
}

TEST(MapStore, CompactingKeepsTheMap) {
  const TempFolder folder;
  const StoreDrive drive = ShortStreet(60);
  const std::string path = MakeMap(folder, drive);
  const std::string before = TextOf(MapStore(path).Results(), Vec3(0, -1, 0));
  CompactMap(path);
  EXPECT_FALSE(fs::exists(path + "-wal"));
  EXPECT_TRUE(MapStore(path).Verify().empty());
  EXPECT_EQ(TextOf(MapStore(path).Results(), Vec3(0, -1, 0)), before);
}

}  // namespace
}  // namespace sslcd
