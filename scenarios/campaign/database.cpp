#include "scenarios/campaign/database.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "scenarios/campaign/internal/compressed.h"
#include "scenarios/campaign/internal/sqlite.h"

namespace alula::scenarios::campaign {
namespace {

using internal::Statement;
using internal::ThrowSqlite;
using Json = nlohmann::ordered_json;

constexpr std::int64_t kVersion = 1;
constexpr const char* kSchema = R"sql(
BEGIN IMMEDIATE;
CREATE TABLE IF NOT EXISTS sweep (key TEXT PRIMARY KEY, value TEXT NOT NULL);
CREATE TABLE IF NOT EXISTS runs (
  seed INTEGER PRIMARY KEY,
  outcome TEXT NOT NULL,           -- pass, fail, fault
  reason TEXT NOT NULL,            -- why the run ended
  failure TEXT NOT NULL,           -- of a fault its reason, of a failure the checks that failed
  message TEXT NOT NULL,           -- of a fault
  digest TEXT NOT NULL,
  numeric_class TEXT NOT NULL,
  program TEXT NOT NULL,           -- which build
  parameters TEXT NOT NULL,        -- JSON: {key: {kind, value, number}}
  checks TEXT NOT NULL,            -- JSON, as in verdict.json
  metrics TEXT NOT NULL,           -- JSON, as in verdict.json
  wall_s REAL NOT NULL,
  cpu_s REAL NOT NULL,
  peak_memory_mb REAL NOT NULL,
  scenario_name TEXT NOT NULL,
  scenario BLOB NOT NULL,          -- scenario.yaml, compressed
  interval_digests BLOB NOT NULL   -- digests.csv, compressed
);
COMMIT;
)sql";
constexpr const char* kColumns =
    "seed, outcome, reason, failure, message, digest, numeric_class, program, parameters, checks, metrics, wall_s, "
    "cpu_s, peak_memory_mb, scenario_name, scenario, interval_digests";

std::string ParametersJson(const std::map<std::string, base::Drawn>& parameters) {
  Json json = Json::object();
  for (const auto& [path, drawn] : parameters) {
    json[path] = {{"kind", drawn.kind},
                  {"value", drawn.value},
                  {"number", std::isfinite(drawn.number) ? Json(drawn.number) : Json(nullptr)}};
  }
  return json.dump();
}

std::map<std::string, base::Drawn> ParametersOf(const std::string& text) {
  std::map<std::string, base::Drawn> parameters;
  const Json json = Json::parse(text);
  for (const auto& [path, drawn] : json.items()) {
    const Json& number = drawn.at("number");
    parameters[path] = {drawn.at("kind"), drawn.at("value"), number.is_null() ? std::nan("") : number.get<double>()};
  }
  return parameters;
}

/// The verdict's own JSON, with the columns that have their own place taken out.
Verdict VerdictOf(const Statement& s) {
  Json json;
  json["outcome"] = s.Text(1);
  json["reason"] = s.Text(2);
  json["message"] = s.Text(4);
  json["checks"] = Json::parse(s.Text(9));
  json["metrics"] = Json::parse(s.Text(10));
  json["digest"] = s.Text(5);
  json["digests"] = Json::object();
  json["numeric_class"] = s.Text(6);
  json["versions"] = Json::object();
  json["seed"] = s.Integer(0);
  json["scenario"] = s.Text(14);
  return VerdictFromJson(json.dump());
}

Row RowOf(const Statement& s, bool whole) {
  Row row;
  row.verdict = VerdictOf(s);
  row.program = s.Text(7);
  row.parameters = ParametersOf(s.Text(8));
  row.wall_s = s.Real(11);
  row.cpu_s = s.Real(12);
  row.peak_memory_mb = s.Real(13);
  if (whole) {
    row.scenario_yaml = internal::Expanded(s.Blob(15));
    row.interval_digests = internal::Expanded(s.Blob(16));
  }
  return row;
}

}  // namespace

struct Database::Connection {
  sqlite3* handle = nullptr;
  ~Connection() { sqlite3_close(handle); }
  void Execute(const char* sql, const std::filesystem::path& file) const {
    if (sqlite3_exec(handle, sql, nullptr, nullptr, nullptr) != SQLITE_OK) ThrowSqlite(handle, file);
  }
};

Database::Database(const std::filesystem::path& file, Mode mode)
    : file_(file), connection_(std::make_unique<Connection>()) {
  const int flags = mode == Mode::kRead ? SQLITE_OPEN_READONLY : SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
  if (mode == Mode::kRead && !std::filesystem::exists(file_)) throw base::InputError(file_.string() + ": no such file");
  if (sqlite3_open_v2(file_.c_str(), &connection_->handle, flags, nullptr) != SQLITE_OK) {
    ThrowSqlite(connection_->handle, file_);
  }
  sqlite3_busy_timeout(connection_->handle, 10'000);  // ms; somebody may be reading
  sqlite3_extended_result_codes(connection_->handle, 0);
  if (mode == Mode::kWrite) {
    if (sqlite3_db_readonly(connection_->handle, "main") == 1) {
      throw base::InputError(file_.string() + ": is read-only; name an --out that can be written");
    }
    connection_->Execute(kSchema, file_);
  }
  const std::optional<std::string> version = Fact("version");
  if (!version && mode == Mode::kWrite) SetFact("version", std::to_string(kVersion));
  if (version && *version != std::to_string(kVersion)) {
    throw base::InputError(file_.string() + ": is of another version of Alula (" + *version + "; this one reads " +
                           std::to_string(kVersion) + ")");
  }
}

Database::~Database() = default;

void Database::Insert(const Row& row) {
  const Verdict& v = row.verdict;
  const Json json = Json::parse(scenarios::ToJson(v));
  const std::string sql = "INSERT INTO runs (" + std::string(kColumns) +
                          ") VALUES (?1,?2,?3,?4,?5,?6,?7,?8,?9,?10,?11,?12,?13,?14,?15,?16,?17)";
  Statement insert(connection_->handle, file_, sql.c_str());
  insert.Bind(1, static_cast<std::int64_t>(v.seed));
  insert.Bind(2, std::string_view(Word(v.outcome)));
  insert.Bind(3, v.reason);
  insert.Bind(4, FailureOf(v));
  insert.Bind(5, v.message);
  insert.Bind(6, v.digest);
  insert.Bind(7, v.numeric_class);
  insert.Bind(8, row.program);
  insert.Bind(9, ParametersJson(row.parameters));
  insert.Bind(10, json.at("checks").dump());
  insert.Bind(11, json.at("metrics").dump());
  insert.Bind(12, row.wall_s);
  insert.Bind(13, row.cpu_s);
  insert.Bind(14, row.peak_memory_mb);
  insert.Bind(15, v.scenario);
  insert.BindBlob(16, internal::Compressed(row.scenario_yaml));
  insert.BindBlob(17, internal::Compressed(row.interval_digests));
  insert.Step();
}

std::set<std::uint64_t> Database::Seeds() const {
  Statement select(connection_->handle, file_, "SELECT seed FROM runs");
  std::set<std::uint64_t> seeds;
  while (select.Step()) seeds.insert(static_cast<std::uint64_t>(select.Integer(0)));
  return seeds;
}

std::optional<Row> Database::Find(std::uint64_t seed) const {
  const std::string sql = "SELECT " + std::string(kColumns) + " FROM runs WHERE seed = ?1";
  Statement select(connection_->handle, file_, sql.c_str());
  select.Bind(1, static_cast<std::int64_t>(seed));
  if (!select.Step()) return std::nullopt;
  return RowOf(select, true);
}

std::vector<Row> Database::Rows() const {
  const std::string sql = "SELECT " + std::string(kColumns) + " FROM runs ORDER BY seed";
  Statement select(connection_->handle, file_, sql.c_str());
  std::vector<Row> rows;
  while (select.Step()) rows.push_back(RowOf(select, false));
  return rows;
}

void Database::CheckSame(const Row& theirs, const std::filesystem::path& other) const {
  const std::optional<Row> ours = Find(theirs.verdict.seed);
  const bool comparable =
      ours->verdict.numeric_class == theirs.verdict.numeric_class && ours->program == theirs.program;
  if (!comparable || ours->verdict.digest == theirs.verdict.digest) return;
  throw base::FaultError("digest", "seed " + std::to_string(theirs.verdict.seed) + " gave digest " +
                                       ours->verdict.digest + " and, in " + other.string() + ", " +
                                       theirs.verdict.digest + "; `alula replay --diff` shows where they part");
}

std::int64_t Database::Merge(const std::filesystem::path& other) {
  const Database source(other, Mode::kRead);
  const std::set<std::uint64_t> mine = Seeds();
  std::int64_t added = 0;
  connection_->Execute("BEGIN IMMEDIATE", file_);
  try {
    for (const std::uint64_t seed : source.Seeds()) {
      const std::optional<Row> theirs = source.Find(seed);
      if (mine.contains(seed)) {
        CheckSame(*theirs, other);
      } else {
        Insert(*theirs);
        ++added;
      }
    }
    connection_->Execute("COMMIT", file_);
  } catch (...) {
    sqlite3_exec(connection_->handle, "ROLLBACK", nullptr, nullptr, nullptr);
    throw;
  }
  return added;
}

std::optional<std::string> Database::Fact(const std::string& key) const {
  Statement table(connection_->handle, file_, "SELECT count(*) FROM sqlite_master WHERE name IN ('sweep', 'runs')");
  if (!table.Step() || table.Integer(0) != 2) throw base::InputError(file_.string() + ": is no database of a sweep");
  Statement select(connection_->handle, file_, "SELECT value FROM sweep WHERE key = ?1");
  select.Bind(1, std::string_view(key));
  if (!select.Step()) return std::nullopt;
  return select.Text(0);
}

void Database::SetFact(const std::string& key, const std::string& value) {
  Statement insert(connection_->handle, file_, "INSERT OR REPLACE INTO sweep (key, value) VALUES (?1, ?2)");
  insert.Bind(1, std::string_view(key));
  insert.Bind(2, std::string_view(value));
  insert.Step();
}

}  // namespace alula::scenarios::campaign
