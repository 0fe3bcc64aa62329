#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "scenarios/campaign/row.h"

namespace alula::scenarios::campaign {

/// The results of a sweep in one SQLite file (tables `sweep` and `runs`; README.md names the columns). Each row goes in
/// whole or not at all, whatever happens to the process or the machine.
///
/// Throws base::InputError where the file cannot be used (it is no sweep, of another version, read-only), and
/// base::FaultError("disk") where the disk is full.
class Database {
 public:
  enum class Mode { kRead, kWrite };  // kWrite makes the file where there is none
  Database(const std::filesystem::path& file, Mode mode);
  ~Database();
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  /// Throws base::FaultError("database") where the seed is there already.
  void Insert(const Row& row);
  std::set<std::uint64_t> Seeds() const;
  std::optional<Row> Find(std::uint64_t seed) const;
  /// All of them by seed; without scenario texts and interval digests, which Find gives.
  std::vector<Row> Rows() const;
  /// Takes over the rows of another database. A row that both have must say the same: the same run gives the same
  /// digest. Throws base::FaultError("digest") otherwise. Gives how many were new.
  std::int64_t Merge(const std::filesystem::path& other);

  /// Facts about the sweep as a whole ("scenario", "plan", "program").
  std::optional<std::string> Fact(const std::string& key) const;
  void SetFact(const std::string& key, const std::string& value);

  const std::filesystem::path& file() const { return file_; }

 private:
  void CheckSame(const Row& theirs, const std::filesystem::path& other) const;

  struct Connection;
  std::filesystem::path file_;
  std::unique_ptr<Connection> connection_;
};

}  // namespace alula::scenarios::campaign
