// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "sslcd/core/error.h"

struct sqlite3;
struct sqlite3_stmt;

namespace sslcd {

/// A connection to an SQLite file. Every failure throws an Error that names the file, the reason
/// and a way out: kBadInput for a damaged file, kOutput if it cannot be read or written.
class Database {
 public:
  enum class Access {
    kRead,    ///< the file must exist
    kWrite,   ///< the file must exist and be writable
    kCreate,  ///< makes the file if there is none
  };
  Database(const std::string& path, Access access);

  /// Runs statements without results.
  void Execute(const std::string& sql);
  /// The first value of the first row.
  std::int64_t Integer(const std::string& sql);

  /// Throws Error(kBadInput) if the file lacks its end.
  void CheckLength() const;

  const std::string& path() const { return path_; }
  sqlite3* handle() const { return handle_.get(); }
  [[noreturn]] void Fail() const;  ///< throws what the last call on this connection failed by

 private:
  struct Close {
    void operator()(sqlite3* handle) const;
  };
  bool Open(const std::string& name, int flags);  // false: it failed

  std::string path_;
  std::unique_ptr<sqlite3, Close> handle_;
};

/// A prepared statement. Parameters are bound in order, from the first one after each reset.
/// Throws Error(kBadInput): the map at `path` is damaged, as `problem` says, with a way out.
[[noreturn]] void ThrowDamaged(const std::string& path, const std::string& problem);
/// The problem of an error that ThrowDamaged has thrown for this path; else its text.
std::string DamageIn(const Error& error, const std::string& path);

class Statement {
 public:
  Statement(Database& database, const std::string& sql);

  Statement& Bind(std::int64_t value);
  Statement& Bind(int value) { return Bind(std::int64_t{value}); }
  Statement& Bind(double value);  ///< NaN becomes NULL
  Statement& BindText(std::string_view text);
  Statement& BindBlob(std::string_view bytes);
  Statement& BindNull();

  bool Step();  ///< true: there is a row
  void Run();   ///< steps to the end, and resets

  /// Values of the row; columns count from 0.
  int columns() const;
  bool IsNull(int column) const;
  std::int64_t Integer(int column) const;
  int Int(int column) const;        ///< throws Error(kBadInput) beyond 32 bits
  double Real(int column) const;    ///< NaN for NULL
  double Finite(int column) const;  ///< throws Error(kBadInput) for NULL and infinity
  std::string Text(int column) const;
  std::string Blob(int column) const;
  /// The value as bytes that tell types apart, for a checksum: a letter, then 8 bytes, or a length
  /// and the content.
  std::string Canonical(int column) const;
  /// ThrowDamaged: there is `what`.
  [[noreturn]] void Refuse(const std::string& what) const;

 private:
  struct Finalise {
    void operator()(sqlite3_stmt* statement) const;
  };
  void Check(int code) const;

  Database& database_;
  std::unique_ptr<sqlite3_stmt, Finalise> statement_;
  int bound_ = 0;
};

/// All or nothing: what is not committed is rolled back.
class Transaction {
 public:
  /// Readers see one state of the file, writers are alone.
  enum class Kind { kRead, kWrite };
  Transaction(Database& database, Kind kind);
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  void Commit();

 private:
  Database& database_;
  bool open_ = true;
};

}  // namespace sslcd
