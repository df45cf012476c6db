// SPDX-License-Identifier: BSD-3-Clause
#include "store/schema.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "../support/temp_folder.h"
#include "sslcd/store/map_session.h"

namespace sslcd {
namespace {

using Access = Database::Access;

std::string NewMap(const TempFolder& folder, const std::string& name = "site.db") {
  const std::string path = folder.In(name);
  MapSession::Begin(path, {"one"}, {}, std::nullopt);
  return path;
}

void Change(const std::string& path, const std::string& sql) {
  Database(path, Access::kWrite).Execute(sql);
}

TEST(Schema, ANewMapIsMadeAndOpenedAgain) {
  const TempFolder folder;
  const std::string path = NewMap(folder);
  Database database = OpenMap(path, Access::kRead);
  EXPECT_EQ(database.Integer("PRAGMA application_id"), kApplicationId);
  EXPECT_EQ(SchemaText(database), PresentSchemaText());
  EXPECT_EQ(database.Integer("PRAGMA synchronous"), 2) << "FULL";
  OpenMap(path, Access::kCreate);  // is left as it is
}

TEST(Schema, EachKindOfFileHasItsOwnMessage) {
  const TempFolder folder;
  const std::string path = NewMap(folder);
  ExpectError([&] { OpenMap(folder.In("none.db"), Access::kRead); }, {"none.db", "no such map"});
  ExpectError([&] { OpenMap(folder.path(), Access::kCreate); }, {"is a folder"});
  ExpectError([] { OpenMap("/dev/zero", Access::kRead); }, {"/dev/zero: is a device"});
  ExpectError([&] { OpenMap(folder.Write("a.txt", std::string(2000, 'a')), Access::kCreate); },
              {"a.txt", "not an SQLite file"});
  ExpectError([&] { OpenMap(folder.Write("empty.db", ""), Access::kRead); }, {"has no map"});

  const std::string other = folder.In("other.db");
  { Database(other, Access::kCreate).Execute("CREATE TABLE t (a)"); }
  for (const Access access : {Access::kRead, Access::kWrite, Access::kCreate})
    ExpectError([&] { OpenMap(other, access); }, {"database of another program"});
  EXPECT_EQ(Database(other, Access::kRead).Integer("SELECT count(*) FROM sqlite_schema"), 1);

  Change(path, "PRAGMA user_version = 99");
  ExpectError([&] { OpenMap(path, Access::kWrite); }, {"has schema 99", "up to 1"});
  Change(path, "PRAGMA user_version = 0");
  ExpectError([&] { OpenMap(path, Access::kRead); }, {"older schema 0", "map compact"});
}

TEST(Schema, AnEmptyFileBecomesAMap) {
  const TempFolder folder;  // a program was killed before it wrote anything
  const std::string path = folder.Write("empty.db", "");
  EXPECT_FALSE(HasMap(path));
  EXPECT_FALSE(HasMap(folder.In("none.db")));
  Database database = OpenMap(path, Access::kCreate);
  EXPECT_FALSE(HasMap(path)) << "no session yet";
  ExpectError([&] { OpenMap(path, Access::kRead); }, {"has no map"});
  EXPECT_EQ(SchemaText(database), PresentSchemaText());
}

TEST(Schema, MissingStepsAreRunInOrderAllOrNone) {
  Database database(":memory:", Access::kCreate);
  const std::string first = "CREATE TABLE t (a); INSERT INTO t VALUES (1)";
  Migrate(database, {first});
  EXPECT_EQ(KindOf(database, 1), FileKind::kMap);
  EXPECT_EQ(KindOf(database, 2), FileKind::kOlder);
  EXPECT_EQ(KindOf(database, 0), FileKind::kNewer);
  const std::string second = "ALTER TABLE t ADD COLUMN b DEFAULT 5", wrong = "no SQL";
  EXPECT_THROW(Migrate(database, {first, second, wrong}), Error);
  EXPECT_EQ(KindOf(database, 1), FileKind::kMap) << "nothing has happened";
  Migrate(database, {first, second, "UPDATE t SET b = b + 1"});
  EXPECT_EQ(database.Integer("SELECT b FROM t"), 6);
  EXPECT_EQ(KindOf(database, 3), FileKind::kMap);
}

TEST(Schema, AFileThatLacksItsEndIsRefused) {
  const TempFolder folder;
  const std::string path = NewMap(folder);
  const auto size = std::filesystem::file_size(path);
  for (const std::uintmax_t left :
       {size - 1, size / 2, std::uintmax_t{4096}, std::uintmax_t{200}}) {
    const std::string cut = folder.In("cut.db");
    std::filesystem::copy_file(path, cut, std::filesystem::copy_options::overwrite_existing);
    std::filesystem::resize_file(cut, left);
    ExpectError([&] { OpenMap(cut, Access::kRead); },
                {"cut.db: is cut short: it has " + std::to_string(left) + " of " +
                 std::to_string(size) + " bytes"});
  }
}

TEST(Schema, NamesWithSpecialCharactersAreRead) {
  const TempFolder folder;
  const std::string path = NewMap(folder, "a ?b#c%20.db");
  EXPECT_TRUE(std::filesystem::exists(path));
  OpenMap(path, Access::kRead);
}

}  // namespace
}  // namespace sslcd
