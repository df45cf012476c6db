// SPDX-License-Identifier: BSD-3-Clause
#include <cstdint>
#include <fstream>
#include <limits>
#include <stdexcept>

#include "input_file.h"
#include "sslcd/store/map_session.h"
#include "sslcd/store/map_store.h"
#include "store/checksums.h"
#include "store/journal.h"
#include "store/site.h"
#include "targets.h"

namespace sslcd::fuzz {
namespace {

std::string MapWith(const std::string& bytes) {
  std::string path = EmptyFolder() + "/map.sslcd";
  std::ofstream stream(path, std::ios::binary);
  stream << bytes;
  if (!stream.flush()) throw std::runtime_error("no room for " + path);
  return path;
}

// Each question by itself: a wrong checksum of the results says nothing of the inputs.
void Ask(const std::string& path) {
  using Question = void (*)(const MapStore&);
  const Question questions[] = {
      [](const MapStore& map) { map.Describe(); }, [](const MapStore& map) { map.Results(); },
      [](const MapStore& map) { map.History(); },  [](const MapStore& map) { map.Reference(); },
      [](const MapStore& map) { map.Verify(); },
  };
  Run(HasMap, path);
  const auto ask_all = [&](const std::string&) {
    const MapStore map(path);  // opened once, which takes most of the time
    for (const Question& question : questions)
      Run([&](const std::string&) { question(map); }, path);
  };
  Run(ask_all, path);
}

// The checksums of what is there now, as of a file that was made to deceive.
void Seal(const std::string& path) {
  Database database(path, Database::Access::kWrite);
  database.Execute("PRAGMA synchronous = OFF");
  Transaction transaction(database, Transaction::Kind::kWrite);
  for (SessionInfo& session : ReadInfo(database).sessions) {
    session.inputs = 0;
    session.checksum = FirstChecksum();
    ReadInputs(database, {}, [&](const StoredInput& input) {
      if (input.session != session.id) return;
      ++session.inputs;
      session.checksum = NextChecksum(session.checksum, input.kind, input.content);
    });
    WriteSession(database, session);
  }
  for (const auto* tables : {&kSiteTables, &kResultTables}) UpdateChecksums(database, *tables);
  transaction.Commit();
}

// A frame after those that the session has, and its end.
void DriveOn(MapSession session) {
  const SessionInfo info = session.info();
  const Trajectory driven = session.mapper().CameraTrajectory();
  const std::int64_t next =
      info.last_frame ? std::int64_t{*info.last_frame} - info.frame_offset + 1 : 0;
  if (next >= 0 && next <= std::numeric_limits<int>::max()) {
    Frame frame;
    frame.index = static_cast<int>(next);
    frame.stamp = driven.stamps.empty() ? 0 : driven.stamps.back() + 0.1;
    Detection detection;
    detection.label = "Car";
    detection.T_cam_object = Pose(lie::SO3<double>(), Vec3(0, 0, 8));
    detection.dims = Vec3(4, 1.8, 1.5);
    frame.detections.push_back(detection);
    Run([&](const std::string&) { session.AddFrame(frame); }, "");
  }
  session.End();
}

void ReadMap(const std::string& bytes) {
  const std::string path = MapWith(bytes);
  Ask(path);
  Run(CompactMap, path);
}

void ReadSealedMap(const std::string& bytes) {
  const std::string path = MapWith(bytes);
  Seal(path);
  Ask(path);
  const MapInfo info = MapStore(path).Describe();
  MapperContext context;
  context.gravity = GravityFrame::FromUp(info.up_axis);
  Run([&](const std::string& map) { DriveOn(MapSession::Resume(map, context)); }, path);
  Run([&](const std::string& map) { DriveOn(MapSession::Begin(map, {"fuzz"}, context, {})); },
      path);
}

}  // namespace

Targets Maps() { return {{"map", ReadMap}, {"sealed_map", ReadSealedMap}}; }

}  // namespace sslcd::fuzz
