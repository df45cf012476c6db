// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "sslcd/pipeline/mapper.h"
#include "sslcd/store/map_store.h"
#include "store/database.h"
#include "store/journal.h"
#include "store/write_lock.h"

namespace sslcd {

/// A map that is open for writing. Throws Error(kBadInput) with the first problem of the file.
struct WritableMap {
  WritableMap(const std::string& path, Database::Access access);

  FileLock lock;  // first, so that the file is closed before the lock is given back
  Database database;
  MapInfo info;
  bool is_new = false;     ///< no session yet
  bool has_views = false;  ///< a refinement has used images
};

/// What one transaction adds to a map.
struct StoredBatch {
  const std::vector<StoredInput>* inputs = nullptr;
  const SessionInfo* session = nullptr;
  LabelTable labels;                ///< new ones
  PerCue<int> vector_length;        ///< new ones; 0: none
  const Mapper* results = nullptr;  ///< null: the results stay as they are
};
void StoreBatch(WritableMap& map, const StoredBatch& batch);

/// The results of a mapper that holds these sessions.
MapResults ResultsOf(const Mapper& mapper, const std::vector<SessionInfo>& sessions);

}  // namespace sslcd
