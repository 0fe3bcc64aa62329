#include <gtest/gtest.h>
#include <sqlite3.h>

#include <chrono>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <stdexcept>

#include "tests/scenarios/campaign/slurm/cluster.h"
#include "tests/scenarios/command.h"

namespace alula::scenarios::slurm {
namespace {

namespace fs = std::filesystem;
using scenarios::testing::Alula;
using scenarios::testing::CommandResult;
using scenarios::testing::TemporaryFolder;
using testing::Cluster;

constexpr int kRuns = 40;
const std::string kSeeds = "1-40";

/// All that a run came to, by seed; wall times, memory and the build's name left out.
using Rows = std::map<int, std::vector<std::string>>;
constexpr const char* kWhatCounts = "SELECT seed, outcome, reason, digest, metrics, checks FROM runs ORDER BY seed";

/// Throws where the file is no database of runs, or is busy.
Rows ReadRows(const fs::path& file) {
  sqlite3* opened = nullptr;
  const int code = sqlite3_open_v2(file.c_str(), &opened, SQLITE_OPEN_READONLY, nullptr);
  const std::unique_ptr<sqlite3, int (*)(sqlite3*)> database(opened, sqlite3_close);
  sqlite3_stmt* prepared = nullptr;
  if (code != SQLITE_OK || sqlite3_prepare_v2(opened, kWhatCounts, -1, &prepared, nullptr) != SQLITE_OK) {
    throw std::runtime_error(file.string() + ": " + sqlite3_errmsg(opened));
  }
  const std::unique_ptr<sqlite3_stmt, int (*)(sqlite3_stmt*)> statement(prepared, sqlite3_finalize);
  Rows rows;
  while (sqlite3_step(prepared) == SQLITE_ROW) {
    std::vector<std::string>& row = rows[sqlite3_column_int(prepared, 0)];
    for (int i = 1; i < sqlite3_column_count(prepared); ++i) {
      row.emplace_back(reinterpret_cast<const char*>(sqlite3_column_text(prepared, i)));
    }
  }
  return rows;
}

/// Rows in all shards of a sweep under way; a shard that is being written right now counts as it can be read.
std::size_t RowsInShards(const fs::path& sweep) {
  std::size_t rows = 0;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(sweep / "shards", ignored)) {
    if (entry.path().extension() != ".db") continue;
    try {
      rows += ReadRows(entry.path()).size();
    } catch (const std::runtime_error&) {
      continue;  // not yet a database
    }
  }
  return rows;
}

/// A sweep over the cluster; `harm` is done to it once some, but not all rows are there.
CommandResult SweepWithHarm(Cluster& cluster, const fs::path& out, const std::function<void()>& harm) {
  auto sweep = std::async(std::launch::async, [&out] {
    return Alula({"sweep", "hover", "--seeds", kSeeds, "--jobs", "1", "--out", out.string(), "--engine", "slurm",
                  "--shards", "8", "--watch", "--quiet"});
  });
  const auto over_after = [&sweep](int ms) {
    return sweep.wait_for(std::chrono::milliseconds(ms)) == std::future_status::ready;
  };
  while (RowsInShards(out) == 0 && !over_after(20)) {
  }
  harm();
  const std::size_t rows = RowsInShards(out);
  EXPECT_GT(rows, 0u) << "harmed before it began";
  EXPECT_LT(rows, static_cast<std::size_t>(kRuns)) << "harmed after its end";
  while (!over_after(1000)) cluster.Hurry();
  return sweep.get();
}

class SlurmSweep : public ::testing::Test {
 protected:
  void SetUp() override {
    const std::string why = testing::WhyNoCluster();
    if (!why.empty()) GTEST_SKIP() << why;
    const CommandResult local = Alula({"sweep", "hover", "--seeds", kSeeds, "--out", Out("local").string(), "--quiet"});
    ASSERT_LE(local.exit_code, 1) << local.err;  // 1: a run that fails is a row as well
    expected_ = ReadRows(Out("local") / "sweep.db");
    ASSERT_EQ(expected_.size(), static_cast<std::size_t>(kRuns));
    local_exit_code_ = local.exit_code;
  }

  fs::path Out(const std::string& name) const { return folder_.path() / name; }

  void ExpectAsLocal(const CommandResult& result) {
    EXPECT_EQ(result.exit_code, local_exit_code_) << result.err;
    EXPECT_EQ(ReadRows(Out("slurm") / "sweep.db"), expected_);
  }

  TemporaryFolder folder_{"slurm_sweep"};
  Rows expected_;
  int local_exit_code_ = 0;
};

TEST_F(SlurmSweep, EqualsALocalOneThoughADaemonDies) {
  Cluster cluster;
  ExpectAsLocal(SweepWithHarm(cluster, Out("slurm"), [&cluster] { cluster.KillDaemon("n1"); }));
}

TEST_F(SlurmSweep, EqualsALocalOneThoughANodeDies) {
  Cluster cluster;
  ExpectAsLocal(SweepWithHarm(cluster, Out("slurm"), [&cluster] { cluster.KillNode("n1"); }));
}

}  // namespace
}  // namespace alula::scenarios::slurm
