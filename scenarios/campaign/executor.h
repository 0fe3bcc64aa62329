#pragma once

#include <sys/types.h>

#include <chrono>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "scenarios/campaign/case.h"
#include "scenarios/campaign/row.h"
#include "scenarios/supervisor.h"

namespace alula::scenarios::campaign {

enum class Keep { kFailed, kAll, kNone };

struct ExecutorOptions {
  std::filesystem::path folder;  // runs/<seed>/ is made in it
  std::filesystem::path work;    // of this process alone, while it works
  std::string name;              // of the scenario
  int jobs = 1;
  int workers = 1;
  std::string render = "auto";
  Limits limits;
  Keep keep = Keep::kFailed;
};

/// Flies cases, each as `alula run` in a process of its own, several at a time. A process dies with the sweep.
class Executor {
 public:
  explicit Executor(ExecutorOptions options);
  /// Ends what still flies; nothing of it stays.
  ~Executor();
  Executor(const Executor&) = delete;
  Executor& operator=(const Executor&) = delete;

  bool Full() const { return flying_.size() >= static_cast<std::size_t>(options_.jobs); }
  bool Idle() const { return flying_.empty(); }
  void Start(Case next);

  struct Finished {
    std::size_t index = 0;  // of the case
    Row row;
  };
  /// The next run that ends; none where `patience` passes or Ctrl-C comes first. A run that bad input kept from flying
  /// throws base::InputError, a full disk base::FaultError("disk").
  std::optional<Finished> Wait(std::chrono::milliseconds patience);
  bool Interrupted() const { return interrupted_; }

  /// The row of a case that an earlier sweep flew to its end without noting it; none where there is no such thing.
  std::optional<Row> Adopt(const Case& flown) const;
  /// Called once the row is in the database: what is not kept goes.
  void Settle(const Row& row) const;

  std::filesystem::path FolderOf(std::uint64_t seed) const;

 private:
  struct Flight {
    Case flown;
    std::chrono::steady_clock::time_point begin;
  };
  std::filesystem::path WorkOf(std::uint64_t seed) const;
  pid_t Spawn(const Case& next) const;
  std::optional<Finished> Reap();
  Row RowOf(const Case& flown, int status) const;

  ExecutorOptions options_;
  std::string program_;
  std::map<pid_t, Flight> flying_;
  bool interrupted_ = false;
  sigset_t mask_before_{};
};

/// Which build this is: a hash of the program's file.
std::string ProgramHash();

}  // namespace alula::scenarios::campaign
