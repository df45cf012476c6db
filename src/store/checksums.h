// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "store/database.h"

namespace sslcd {

/// A table, and the columns of its key.
struct TableKey {
  const char* name;
  const char* key;
};
/// Tables that change with every session, and those of the results.
extern const std::vector<TableKey> kSiteTables, kResultTables;

/// SHA-256 over the rows of a table in the order of its key.
std::string TableChecksum(Database& database, const TableKey& table);
/// Stores the checksums of these tables as they are now.
void UpdateChecksums(Database& database, const std::vector<TableKey>& tables);
/// The tables whose rows do not have the checksum that is stored, one sentence each.
std::vector<std::string> ChecksumProblems(Database& database, const std::vector<TableKey>& tables);

/// The problems that need only one pass over the file: of SQLite's own check, the schema, and the
/// checksums of all tables but the inputs. `thorough` compares indices with their tables, too.
std::vector<std::string> FileProblems(Database& database, bool thorough);

}  // namespace sslcd
