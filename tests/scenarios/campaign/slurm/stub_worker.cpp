// Stands for `alula sweep --worker FOLDER --shard K` where the parts around it are tested: claims the shard, does the
// cases that FOLDER/shards/K.rows does not hold yet, one row each, and writes all it does into FOLDER/journal.
// STUB_CASES: of a shard; STUB_CASE_MS: how long one takes.

#include <fcntl.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>
#include <thread>

#include "base/error.h"
#include "scenarios/campaign/slurm/shard_claim.h"

namespace {

using alula::scenarios::slurm::ReadHolder;
using alula::scenarios::slurm::ShardClaim;
using alula::scenarios::slurm::ThisProcess;

constexpr int kTemporaryFailure = 75;  // EX_TEMPFAIL of sysexits.h
constexpr double kWaitForClaimS = 120.0;

std::atomic<bool> interrupted{false};

/// Lines of one write each, so that those of several processes do not mix.
class Journal {
 public:
  Journal(const std::filesystem::path& file, std::string shard)
      : fd_(::open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644)), shard_(std::move(shard)) {
    const char* const node = std::getenv("SLURMD_NODENAME");
    node_ = node == nullptr ? "nowhere" : node;
  }
  void Add(const std::string& event, int number = -1) const {
    const std::string line =
        shard_ + " " + std::to_string(::getpid()) + " " + node_ + " " + event + " " + std::to_string(number) + "\n";
    if (::write(fd_, line.data(), line.size()) < 0) std::exit(1);
  }

 private:
  int fd_;
  std::string shard_, node_;
};

int NumberOf(const char* name) { return std::atoi(std::getenv(name)); }

int CountRows(const std::filesystem::path& file) {
  int rows = 0;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) ++rows;
  return rows;
}

int Work(const std::filesystem::path& folder, const std::string& shard) {
  const Journal journal(folder / "journal", shard);
  journal.Add("start");
  const auto file = folder / "shards" / (shard + ".claim");
  auto claim = ShardClaim::Try(file, ThisProcess());
  if (!claim) {
    journal.Add("wait");
    const auto holder = ReadHolder(file);
    std::cout << "shard " << shard << " is held by " << (holder ? holder->Text() : "another") << std::endl;
    claim = ShardClaim::Wait(file, ThisProcess(), kWaitForClaimS, &interrupted);
  }
  if (!claim) return kTemporaryFailure;
  journal.Add("claim");
  const auto rows = folder / "shards" / (shard + ".rows");
  for (int number = CountRows(rows); number < NumberOf("STUB_CASES"); ++number) {
    journal.Add("begin", number);
    std::this_thread::sleep_for(std::chrono::milliseconds(NumberOf("STUB_CASE_MS")));
    if (interrupted.load()) {
      journal.Add("term");
      return kTemporaryFailure;
    }
    if (!claim->StillHeld()) {
      journal.Add("lost");
      return kTemporaryFailure;
    }
    std::ofstream(rows, std::ios::app) << number << std::endl;
  }
  journal.Add("complete");
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 6 || std::string(argv[1]) != "sweep" || std::string(argv[2]) != "--worker" ||
      std::string(argv[4]) != "--shard") {
    std::cerr << "usage: sweep --worker FOLDER --shard K\n";
    return 2;
  }
  std::signal(SIGTERM, [](int) { interrupted.store(true); });
  try {
    return Work(argv[3], argv[5]);
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 2;
  }
}
