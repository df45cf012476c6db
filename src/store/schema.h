// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "store/database.h"

namespace sslcd {

/// Marks an SQLite file as a map of sslcd (PRAGMA application_id): "SLCD".
inline constexpr int kApplicationId = 0x534c4344;

/// The steps from an empty file to the present schema: migration i makes version i + 1 (PRAGMA
/// user_version) of version i. Steps that have been released never change.
const std::vector<std::string>& SchemaMigrations();

/// Runs the steps that are missing, all or none, and sets the version.
void Migrate(Database& database, const std::vector<std::string>& migrations);

/// What a file is.
enum class FileKind {
  kEmpty,    ///< an SQLite file without content: a map that was about to be made
  kMap,      ///< a map of the present schema
  kOlder,    ///< a map of an older schema, which Migrate updates
  kNewer,    ///< a map of a newer schema, which this program cannot read
  kForeign,  ///< the database of another program
};
FileKind KindOf(Database& database, int known_version);

/// The SQL of all tables and indices, in order of their names, as the file holds it.
std::string SchemaText(Database& database);
/// The same of a file of the present schema.
const std::string& PresentSchemaText();

/// Whether the file, which must be there, is a map with a session. Throws Error as OpenMap does,
/// but not for a map without one.
bool HoldsMap(const std::string& path);

/// Opens a map and checks what the file is. With Access::kCreate it makes the tables of a new one;
/// with it and kWrite, those of an older schema are updated. Throws Error as Database does, and
/// kBadInput for each other kind of file with a way out; for a map without a session, too, but with
/// kCreate.
Database OpenMap(const std::string& path, Database::Access access);

}  // namespace sslcd
