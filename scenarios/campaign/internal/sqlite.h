#pragma once

#include <sqlite3.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace alula::scenarios::campaign::internal {

/// Throws what an SQLite result code means to the person who named the file (database.h).
[[noreturn]] void ThrowSqlite(sqlite3* connection, const std::filesystem::path& file);

/// One statement: bound by position from 1, stepped, read by column from 0.
class Statement {
 public:
  Statement(sqlite3* connection, const std::filesystem::path& file, const char* sql);
  ~Statement() { sqlite3_finalize(statement_); }
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  void Bind(int position, std::int64_t value);
  void Bind(int position, double value);
  void Bind(int position, std::string_view text);
  void BindBlob(int position, std::string_view bytes);
  /// True where a row came.
  bool Step();

  std::int64_t Integer(int column) const { return sqlite3_column_int64(statement_, column); }
  double Real(int column) const { return sqlite3_column_double(statement_, column); }
  std::string Text(int column) const;
  std::string Blob(int column) const;

 private:
  void Check(int result) const;

  sqlite3* connection_;
  const std::filesystem::path& file_;
  sqlite3_stmt* statement_ = nullptr;
};

}  // namespace alula::scenarios::campaign::internal
