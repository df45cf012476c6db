// SPDX-License-Identifier: BSD-3-Clause
#include "store/schema.h"

#include <filesystem>

#include "sslcd/core/error.h"
#include "store/schema_sql.h"

namespace sslcd {
namespace {

namespace fs = std::filesystem;

int PresentVersion() { return static_cast<int>(SchemaMigrations().size()); }

[[noreturn]] void Refuse(const std::string& path, const std::string& why) {
  throw Error(ErrorKind::kBadInput, path + ": " + why);
}

// The tables of a new map are made before its first row.
bool HasSite(Database& database) { return database.Integer("SELECT count(*) FROM site") > 0; }

void CheckKind(Database& database, Database::Access access) {
  const std::string& path = database.path();
  const std::string version = std::to_string(database.Integer("PRAGMA user_version"));
  switch (KindOf(database, PresentVersion())) {
    case FileKind::kMap:
      if (access == Database::Access::kCreate || HasSite(database)) return;
      break;
    case FileKind::kForeign:
      Refuse(path, "is the database of another program, not a map of sslcd; name another file");
    case FileKind::kNewer:
      Refuse(path, "has schema " + version + ", and this program knows schemas up to " +
                       std::to_string(PresentVersion()) +
                       ": use the program that wrote it, or a "
                       "newer one");
    case FileKind::kOlder:
      if (access == Database::Access::kRead)
        Refuse(path, "has the older schema " + version + "; `sslcd_run map compact` updates it");
      Migrate(database, SchemaMigrations());
      return;
    case FileKind::kEmpty: break;
  }
  if (access != Database::Access::kCreate)
    Refuse(path,
           "has no map: its first session was ended before anything was stored; "
           "`sslcd_run run DATASET --map FILE` begins one");
  // first, since a reader cannot take back what is half done without it
  database.Execute("PRAGMA journal_mode = WAL");
  Migrate(database, SchemaMigrations());
}

}  // namespace

const std::vector<std::string>& SchemaMigrations() {
  static const std::vector<std::string> migrations = {kSchema1};
  return migrations;
}

void Migrate(Database& database, const std::vector<std::string>& migrations) {
  Transaction transaction(database, Transaction::Kind::kWrite);
  const auto from = static_cast<std::size_t>(database.Integer("PRAGMA user_version"));
  for (std::size_t i = from; i < migrations.size(); ++i) database.Execute(migrations[i]);
  database.Execute("PRAGMA application_id = " + std::to_string(kApplicationId) +
                   "; PRAGMA user_version = " + std::to_string(migrations.size()));
  transaction.Commit();
}

FileKind KindOf(Database& database, int known_version) {
  const std::int64_t application = database.Integer("PRAGMA application_id");
  const std::int64_t version = database.Integer("PRAGMA user_version");
  if (application != kApplicationId) {
    const bool empty = database.Integer("SELECT count(*) FROM sqlite_schema") == 0;
    return empty && application == 0 && version == 0 ? FileKind::kEmpty : FileKind::kForeign;
  }
  if (version == known_version) return FileKind::kMap;
  return version < known_version ? FileKind::kOlder : FileKind::kNewer;
}

std::string SchemaText(Database& database) {
  std::string text;
  Statement rows(database, "SELECT sql FROM sqlite_schema ORDER BY type, name");
  while (rows.Step()) text += rows.Text(0) + "\n";
  return text;
}

const std::string& PresentSchemaText() {
  static const std::string text = [] {
    Database database(":memory:", Database::Access::kCreate);
    Migrate(database, SchemaMigrations());
    return SchemaText(database);
  }();
  return text;
}

bool HoldsMap(const std::string& path) {
  std::error_code none;
  if (fs::is_directory(path, none)) Refuse(path, "is a folder; name a file");
  Database database(path, Database::Access::kRead);
  const FileKind kind = KindOf(database, PresentVersion());
  if (kind == FileKind::kEmpty || (kind == FileKind::kMap && !HasSite(database))) return false;
  database.CheckLength();
  CheckKind(database, Database::Access::kRead);
  return true;
}

Database OpenMap(const std::string& path, Database::Access access) {
  std::error_code none;
  if (fs::is_directory(path, none)) Refuse(path, "is a folder; name a file");
  if (access != Database::Access::kCreate && !fs::exists(path, none))
    Refuse(path, "no such map; `sslcd_run run DATASET --map FILE` begins one");
  Database database(path, access);
  database.CheckLength();
  CheckKind(database, access);
  // readers go on while one writes
  if (access != Database::Access::kRead) database.Execute("PRAGMA journal_mode = WAL");
  return database;
}

}  // namespace sslcd
