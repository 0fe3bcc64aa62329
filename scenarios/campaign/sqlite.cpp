#include "scenarios/campaign/internal/sqlite.h"

#include "base/error.h"

namespace alula::scenarios::campaign::internal {

void ThrowSqlite(sqlite3* connection, const std::filesystem::path& file) {
  const std::string name = file.string();
  switch (sqlite3_errcode(connection) & 0xff) {
    case SQLITE_FULL:
      throw base::FaultError("disk", name + ": the disk is full");
    case SQLITE_IOERR:
      throw base::FaultError("disk", name + ": the disk fails (" + sqlite3_errmsg(connection) + ")");
    case SQLITE_READONLY:
    case SQLITE_PERM:
      throw base::InputError(name + ": is read-only; name an --out that can be written");
    case SQLITE_CANTOPEN:
      throw base::InputError(name + ": cannot be opened");
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      throw base::InputError(name + ": is in use by another program");
    case SQLITE_NOTADB:
    case SQLITE_CORRUPT:
      throw base::InputError(name + ": is no database of a sweep");
    default:
      throw base::FaultError("database", name + ": " + sqlite3_errmsg(connection));
  }
}

Statement::Statement(sqlite3* connection, const std::filesystem::path& file, const char* sql)
    : connection_(connection), file_(file) {
  Check(sqlite3_prepare_v2(connection, sql, -1, &statement_, nullptr));
}

void Statement::Check(int result) const {
  if (result != SQLITE_OK) ThrowSqlite(connection_, file_);
}

void Statement::Bind(int position, std::int64_t value) { Check(sqlite3_bind_int64(statement_, position, value)); }
void Statement::Bind(int position, double value) { Check(sqlite3_bind_double(statement_, position, value)); }
void Statement::Bind(int position, std::string_view text) {
  Check(sqlite3_bind_text64(statement_, position, text.data(), text.size(), SQLITE_TRANSIENT, SQLITE_UTF8));
}
void Statement::BindBlob(int position, std::string_view bytes) {
  Check(sqlite3_bind_blob64(statement_, position, bytes.data(), bytes.size(), SQLITE_TRANSIENT));
}

bool Statement::Step() {
  const int result = sqlite3_step(statement_);
  if (result == SQLITE_ROW) return true;
  if (result != SQLITE_DONE) ThrowSqlite(connection_, file_);
  return false;
}

std::string Statement::Text(int column) const {
  const auto* const text = reinterpret_cast<const char*>(sqlite3_column_text(statement_, column));
  return text == nullptr ? "" : std::string(text, static_cast<std::size_t>(sqlite3_column_bytes(statement_, column)));
}

std::string Statement::Blob(int column) const {
  const auto* const bytes = static_cast<const char*>(sqlite3_column_blob(statement_, column));
  return bytes == nullptr ? "" : std::string(bytes, static_cast<std::size_t>(sqlite3_column_bytes(statement_, column)));
}

}  // namespace alula::scenarios::campaign::internal
