// SPDX-License-Identifier: BSD-3-Clause
#include "store/map_copy.h"

#include <fcntl.h>
#include <sqlite3.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "sslcd/core/error.h"
#include "store/schema.h"

namespace sslcd {
namespace {

namespace fs = std::filesystem;

// Makes the names in a folder last; one that may not be read cannot be synchronised.
void SynchroniseFolderOf(const std::string& path) {
  const int folder = open(fs::absolute(path).parent_path().c_str(), O_RDONLY | O_CLOEXEC);
  if (folder < 0) return;
  fsync(folder);
  close(folder);
}

// SQLite does not tell that the last checkpoint of a connection failed, as on a full disk: part of
// the content is in the log then.
void CheckLogIsEmpty(const std::string& path, const std::string& file) {
  std::error_code none;
  if (fs::exists(path + "-wal", none) && fs::file_size(path + "-wal", none) > 0)
    throw Error(ErrorKind::kOutput,
                file +
                    ": its content could not be written as a whole, part of it is in a log; is "
                    "the disk full? Make room and try again");
}

}  // namespace

void CopyDatabase(const Database& from, Database& to) {
  sqlite3_backup* backup = sqlite3_backup_init(to.handle(), "main", from.handle(), "main");
  if (backup == nullptr) to.Fail();
  constexpr int kAllPages = -1, kWaitMs = 50, kMostWaits = 100;
  int code = sqlite3_backup_step(backup, kAllPages);
  for (int i = 0; i < kMostWaits && (code == SQLITE_BUSY || code == SQLITE_LOCKED); ++i) {
    sqlite3_sleep(kWaitMs);
    code = sqlite3_backup_step(backup, kAllPages);
  }
  if (sqlite3_backup_finish(backup) != SQLITE_OK) to.Fail();
  if (code != SQLITE_DONE)
    throw Error(ErrorKind::kOutput,
                to.path() + ": another program holds it; wait until it has ended");
}

std::string WorkingCopy::PathBeside(const std::string& file) { return file + "-merge"; }

WorkingCopy::WorkingCopy(const std::string& map, const std::string& file)
    : path_(PathBeside(file)) {
  Remove();
  try {
    const Database from = OpenMap(map, Database::Access::kRead);
    Database to(path_, Database::Access::kCreate);
    CopyDatabase(from, to);
  } catch (...) {
    Remove();
    throw;
  }
}

WorkingCopy::~WorkingCopy() { Remove(); }

void WorkingCopy::Remove() const {
  std::error_code none;
  for (const char* end : {"", "-journal", "-wal", "-shm", "-lock"}) fs::remove(path_ + end, none);
}

void WorkingCopy::WriteInto(const std::string& map) const {
  const Database from = OpenMap(path_, Database::Access::kRead);
  Database to = OpenMap(map, Database::Access::kWrite);
  CopyDatabase(from, to);
}

void WorkingCopy::MoveTo(const std::string& file) {
  CheckLogIsEmpty(path_, file);
  // a link is refused where the name is taken, a rename would replace that file
  const bool linked = link(path_.c_str(), file.c_str()) == 0;
  if (!linked && (errno == EEXIST || std::rename(path_.c_str(), file.c_str()) != 0))
    throw Error(ErrorKind::kOutput,
                file + ": cannot be written: " + std::strerror(errno) + "; name another file");
  SynchroniseFolderOf(file);
}

}  // namespace sslcd
