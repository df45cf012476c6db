// SPDX-License-Identifier: BSD-3-Clause
#include "store/database.h"

#include <sqlite3.h>

#include <cmath>
#include <filesystem>
#include <limits>

#include "core/regular_file.h"
#include "sslcd/core/error.h"
#include "store/bytes.h"

namespace sslcd {
namespace {

constexpr const char* kIsDamaged = ": is damaged: ";
constexpr const char* kRestore = "; restore a copy, or build the map again from its drives";

constexpr int kBusyTimeoutMs = 5000;  // another program's checkpoint or migration

// The name of a file that nobody changes: readable in a folder that cannot be written. URI of
// SQLite: % ? # stand for themselves only when escaped.
std::string ImmutableUri(const std::string& path) {
  std::string uri = "file:";
  for (const char c : path)
    uri += c == '%' ? "%25" : c == '?' ? "%3f" : c == '#' ? "%23" : std::string(1, c);
  return uri + "?immutable=1";
}

// The length that the file's header tells, and the one it has [bytes].
struct FileLength {
  std::int64_t told = 0, found = 0;
};

std::int64_t BigEndian(const unsigned char* bytes) {
  return std::int64_t{bytes[0]} << 24 | bytes[1] << 16 | bytes[2] << 8 | bytes[3];
}

// Through SQLite's own handle: to open and close the file beside it would end its locks (POSIX).
FileLength LengthOf(sqlite3* handle) {
  sqlite3_file* file = nullptr;
  sqlite3_int64 found = 0;
  unsigned char header[100] = {};
  if (sqlite3_file_control(handle, "main", SQLITE_FCNTL_FILE_POINTER, &file) != SQLITE_OK ||
      file == nullptr || file->pMethods == nullptr ||
      file->pMethods->xFileSize(file, &found) != SQLITE_OK ||
      file->pMethods->xRead(file, header, sizeof header, 0) != SQLITE_OK)
    return {};
  const int size = header[16] << 8 | header[17];
  const bool tells_length = BigEndian(header + 24) == BigEndian(header + 92);
  return {tells_length ? (size == 1 ? 65536 : size) * BigEndian(header + 28) : 0, found};
}

ErrorKind ErrorKindOf(int code) {
  // SQLITE_ERROR: a table or a version that the file should have
  const bool damaged = code == SQLITE_CORRUPT || code == SQLITE_NOTADB || code == SQLITE_ERROR;
  return damaged ? ErrorKind::kBadInput : ErrorKind::kOutput;
}

std::string WayOut(int code) {
  switch (code) {
    case SQLITE_NOTADB: return "it is not an SQLite file; name a map, or a file that is not there";
    case SQLITE_ERROR:
    case SQLITE_CORRUPT:
      return "the file is damaged; `sslcd_run map verify` says where. Restore a copy, or build the "
             "map again from its drives";
    case SQLITE_FULL: return "the disk is full; make room and go on from what is stored";
    case SQLITE_READONLY:
    case SQLITE_PERM: return "it cannot be written; check the rights of the file and its folder";
    case SQLITE_CANTOPEN: return "check the path, and the rights of the file and its folder";
    case SQLITE_BUSY:
    case SQLITE_LOCKED: return "another program writes to it; wait until it has ended";
    default: return "check the disk";
  }
}

}  // namespace

void Database::Close::operator()(sqlite3* handle) const { sqlite3_close_v2(handle); }

bool Database::Open(const std::string& name, int flags) {
  sqlite3* handle = nullptr;
  const int code = sqlite3_open_v2(name.c_str(), &handle, flags | SQLITE_OPEN_NOMUTEX, nullptr);
  handle_.reset(handle);
  if (code != SQLITE_OK) return false;
  sqlite3_extended_result_codes(handle, 1);
  sqlite3_busy_timeout(handle, kBusyTimeoutMs);
  // the file is read here first
  return sqlite3_exec(handle,
                      "PRAGMA trusted_schema = OFF; PRAGMA cell_size_check = ON;"
                      "PRAGMA foreign_keys = ON; PRAGMA schema_version",
                      nullptr, nullptr, nullptr) == SQLITE_OK;
}

Database::Database(const std::string& path, Access access) : path_(path) {
  RequireRegularFile(path);
  if (access == Access::kRead) {
    // Where it may write, the last reader takes the log away when it closes.
    if (Open(path, SQLITE_OPEN_READWRITE)) {
      Execute("PRAGMA query_only = ON");
      return;
    }
    if (Open(path, SQLITE_OPEN_READONLY)) return;
    // Without a right to write in the folder a reader cannot join the others; if there is no log,
    // there are none.
    const int code = sqlite3_errcode(handle_.get()) & 0xff;
    const bool logged = std::filesystem::exists(path + "-wal");
    if ((code == SQLITE_CANTOPEN || code == SQLITE_READONLY) && !logged &&
        Open(ImmutableUri(path), SQLITE_OPEN_READONLY | SQLITE_OPEN_URI))
      return;
    Fail();
  }
  const int create = access == Access::kCreate ? SQLITE_OPEN_CREATE : 0;
  if (!Open(path, SQLITE_OPEN_READWRITE | create)) Fail();
  if (sqlite3_db_readonly(handle_.get(), "main") == 1)
    throw Error(ErrorKind::kOutput, path +
                                        ": cannot be written: the file is read-only; change its "
                                        "rights, or copy it to another folder");
  Execute("PRAGMA synchronous = FULL");  // what is committed survives a loss of power
}

void Database::CheckLength() const {
  std::error_code none;  // what is not in the file yet is in the log
  if (std::filesystem::exists(path_ + "-wal", none) &&
      std::filesystem::file_size(path_ + "-wal", none) > 0)
    return;
  const FileLength length = LengthOf(handle_.get());
  if (length.found >= length.told) return;
  throw Error(ErrorKind::kBadInput,
              path_ + ": is cut short: it has " + std::to_string(length.found) + " of " +
                  std::to_string(length.told) +
                  " bytes; restore a copy, or build the map again from its drives");
}

void Database::Fail() const {
  if ((sqlite3_errcode(handle_.get()) & 0xff) == SQLITE_CORRUPT) CheckLength();
  const int code = sqlite3_errcode(handle_.get()) & 0xff;
  throw Error(ErrorKindOf(code),
              path_ + ": " + sqlite3_errmsg(handle_.get()) + ": " + WayOut(code));
}

void Database::Execute(const std::string& sql) {
  if (sqlite3_exec(handle_.get(), sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) Fail();
}

std::int64_t Database::Integer(const std::string& sql) {
  Statement statement(*this, sql);
  return statement.Step() ? statement.Integer(0) : 0;
}

void ThrowDamaged(const std::string& path, const std::string& problem) {
  throw Error(ErrorKind::kBadInput, path + kIsDamaged + problem + kRestore);
}

std::string DamageIn(const Error& error, const std::string& path) {
  std::string text = error.what();
  const std::string before = path + kIsDamaged;
  if (text.rfind(before, 0) == 0) text.erase(0, before.size());
  return text.substr(0, text.rfind(kRestore));
}

void Statement::Finalise::operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }

Statement::Statement(Database& database, const std::string& sql) : database_(database) {
  sqlite3_stmt* statement = nullptr;
  Check(sqlite3_prepare_v2(database.handle(), sql.c_str(), static_cast<int>(sql.size()), &statement,
                           nullptr));
  statement_.reset(statement);
}

void Statement::Check(int code) const {
  if (code != SQLITE_OK) database_.Fail();
}

Statement& Statement::Bind(std::int64_t value) {
  Check(sqlite3_bind_int64(statement_.get(), ++bound_, value));
  return *this;
}

Statement& Statement::Bind(double value) {
  Check(sqlite3_bind_double(statement_.get(), ++bound_, value));
  return *this;
}

Statement& Statement::BindText(std::string_view text) {
  Check(sqlite3_bind_text(statement_.get(), ++bound_, text.data(), static_cast<int>(text.size()),
                          SQLITE_TRANSIENT));
  return *this;
}

Statement& Statement::BindBlob(std::string_view bytes) {
  Check(sqlite3_bind_blob64(statement_.get(), ++bound_, bytes.data(), bytes.size(),
                            SQLITE_TRANSIENT));
  return *this;
}

Statement& Statement::BindNull() {
  Check(sqlite3_bind_null(statement_.get(), ++bound_));
  return *this;
}

bool Statement::Step() {
  const int code = sqlite3_step(statement_.get());
  if (code != SQLITE_ROW && code != SQLITE_DONE) database_.Fail();
  return code == SQLITE_ROW;
}

void Statement::Run() {
  while (Step()) {
  }
  Check(sqlite3_reset(statement_.get()));
  bound_ = 0;
}

int Statement::columns() const { return sqlite3_column_count(statement_.get()); }
bool Statement::IsNull(int column) const {
  return sqlite3_column_type(statement_.get(), column) == SQLITE_NULL;
}
std::int64_t Statement::Integer(int column) const {
  return sqlite3_column_int64(statement_.get(), column);
}
int Statement::Int(int column) const {
  const std::int64_t value = Integer(column);
  if (value != static_cast<int>(value))
    Refuse("the number " + std::to_string(value) + " where a smaller one belongs");
  return static_cast<int>(value);
}
double Statement::Real(int column) const {
  return IsNull(column) ? std::numeric_limits<double>::quiet_NaN()
                        : sqlite3_column_double(statement_.get(), column);
}
double Statement::Finite(int column) const {
  const double value = Real(column);
  if (!std::isfinite(value)) Refuse("a number that is not finite");
  return value;
}
void Statement::Refuse(const std::string& what) const {
  ThrowDamaged(database_.path(), "it has " + what);
}
std::string Statement::Text(int column) const { return Blob(column); }
std::string Statement::Blob(int column) const {
  const void* bytes = sqlite3_column_blob(statement_.get(), column);
  const int size = sqlite3_column_bytes(statement_.get(), column);
  return size > 0 ? std::string(static_cast<const char*>(bytes), static_cast<std::size_t>(size))
                  : std::string();
}

std::string Statement::Canonical(int column) const {
  ByteWriter bytes;
  switch (sqlite3_column_type(statement_.get(), column)) {
    case SQLITE_INTEGER: bytes.Byte('i').Long(Integer(column)); break;
    case SQLITE_FLOAT: bytes.Byte('r').Real(Real(column)); break;
    case SQLITE_TEXT: bytes.Byte('t').Text(Text(column)); break;
    case SQLITE_BLOB: bytes.Byte('b').Text(Blob(column)); break;
    default: bytes.Byte('n');
  }
  return bytes.Take();
}

Transaction::Transaction(Database& database, Kind kind) : database_(database) {
  database_.Execute(kind == Kind::kWrite ? "BEGIN IMMEDIATE" : "BEGIN");
}

Transaction::~Transaction() {
  // a full disk may have rolled it back already
  if (open_ && sqlite3_get_autocommit(database_.handle()) == 0)
    sqlite3_exec(database_.handle(), "ROLLBACK", nullptr, nullptr, nullptr);
}

void Transaction::Commit() {
  database_.Execute("COMMIT");
  open_ = false;
}

}  // namespace sslcd
