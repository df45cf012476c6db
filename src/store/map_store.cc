// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/store/map_store.h"

#include <filesystem>
#include <map>

#include "sslcd/core/error.h"
#include "store/checksums.h"
#include "store/frame_bytes.h"
#include "store/journal.h"
#include "store/read_history.h"
#include "store/reference_map.h"
#include "store/result_tables.h"
#include "store/schema.h"
#include "store/site.h"
#include "store/write_lock.h"

namespace sslcd {
namespace {

// The frames of a session and the odometry's poses, by their numbers in the map.
using OdometryPoses = std::map<int, Pose>;

OdometryPoses ReadOdometry(Database& database, const std::vector<SessionInfo>& sessions) {
  OdometryPoses poses;
  ReadInputs(database, sessions, [&](const StoredInput& input) {
    if (input.kind != InputKind::kFrame) return;
    const Frame frame = FrameIn(input, database.path());
    for (const SessionInfo& session : sessions)
      if (session.id == input.session)
        poses[NumberInMap(frame.index, session, database.path())] = frame.T_odom_cam;
  });
  return poses;
}

void RefuseDamage(const std::string& path, const std::vector<std::string>& problems) {
  if (!problems.empty()) ThrowDamaged(path, problems.front());
}

void CheckResults(Database& database) {
  RefuseDamage(database.path(), ChecksumProblems(database, kResultTables));
}

MapResults ResultsWithOdometry(Database& database) {
  MapResults results = ReadResults(database);
  const OdometryPoses odometry = ReadOdometry(database, ReadInfo(database).sessions);
  for (SessionPath& path : results.paths) {
    path.odometry.stamps = path.trajectory.stamps;
    for (const int frame : path.frames) {
      const auto pose = odometry.find(frame);
      if (pose == odometry.end())
        ThrowDamaged(database.path(),
                     "frame " + std::to_string(frame) + " has a pose and no input");
      path.odometry.poses.push_back(pose->second);
    }
  }
  return results;
}

}  // namespace

struct SSLCD_HIDDEN MapStore::Impl {
  explicit Impl(const std::string& path) : database(OpenMap(path, Database::Access::kRead)) {}
  Database database;
};

MapStore::MapStore(const std::string& path) : impl_(std::make_unique<Impl>(path)) {}
MapStore::~MapStore() = default;
MapStore::MapStore(MapStore&&) noexcept = default;
MapStore& MapStore::operator=(MapStore&&) noexcept = default;

MapInfo MapStore::Describe() const {
  const Transaction one_state(impl_->database, Transaction::Kind::kRead);
  return ReadInfo(impl_->database);
}

MapResults MapStore::Results() const {
  const Transaction one_state(impl_->database, Transaction::Kind::kRead);
  CheckResults(impl_->database);
  return ResultsWithOdometry(impl_->database);
}

std::vector<Frame> MapStore::Frames(const std::string& session) const {
  Database& database = impl_->database;
  const Transaction one_state(database, Transaction::Kind::kRead);
  for (const SessionInfo& one : ReadInfo(database).sessions) {
    if (one.name != session) continue;
    std::vector<Frame> frames;
    const std::vector<std::string> problems =
        ReadInputs(database, {one}, [&](const StoredInput& input) {
          if (input.session == one.id && input.kind == InputKind::kFrame)
            frames.push_back(FrameIn(input, database.path()));
        });
    RefuseDamage(database.path(), problems);
    return frames;
  }
  throw Error(ErrorKind::kUsage, database.path() + ": has no session '" + session +
                                     "'; `sslcd_run map info` lists those that it has");
}

MapHistory MapStore::History() const {
  const Transaction one_state(impl_->database, Transaction::Kind::kRead);
  CheckResults(impl_->database);
  return ReadHistory(impl_->database);
}

ReferenceMap MapStore::Reference() const {
  Database& database = impl_->database;
  const Transaction one_state(database, Transaction::Kind::kRead);
  CheckResults(database);
  return ReferenceOf(database, ReadInfo(database), ReadResults(database));
}

std::vector<std::string> MapStore::Verify() const {
  Database& database = impl_->database;
  const Transaction one_state(database, Transaction::Kind::kRead);
  std::vector<std::string> problems = FileProblems(database, true);
  if (!problems.empty()) return problems;
  try {
    problems = ReadInputs(database, ReadInfo(database).sessions, [](const StoredInput&) {});
    if (problems.empty() && database.Integer("SELECT count(*) FROM input") !=
                                database.Integer("SELECT total(inputs) FROM session"))
      problems.push_back("there are inputs that belong to no session");
    if (problems.empty()) ResultsWithOdometry(database);
  } catch (const Error& error) {
    problems.push_back(DamageIn(error, database.path()));
  }
  return problems;
}

bool HasMap(const std::string& path) {
  std::error_code none;
  return std::filesystem::exists(path, none) && HoldsMap(path);
}

void CompactMap(const std::string& path) {
  const FileLock lock = LockMap(path);
  Database database = OpenMap(path, Database::Access::kWrite);
  database.Execute("VACUUM; PRAGMA wal_checkpoint(TRUNCATE)");
}

}  // namespace sslcd
