#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/config.h"
#include "scenarios/dataset/dataset_writer.h"

namespace alula::scenarios::internal {

/// The command line, understood. This header is free of CLI11, which only cli.cpp includes: it is slow to compile.
struct CommandLine {
  enum class Verb { kRun, kExport, kList, kCheck, kCheckSensors, kBench };
  Verb verb = Verb::kList;
  std::vector<std::string> names;  // of scenarios, files or benchmarks
  std::optional<std::uint64_t> seed;
  std::vector<base::Override> overrides;
  std::optional<std::filesystem::path> out;
  int workers = 1;
  std::string render = "auto";
  bool video = false;
  std::optional<dataset::Format> dataset;  // of run and export
  bool quiet = false;
  bool json = false;
  std::filesystem::path json_file;  // of bench
};

/// Understands argv. Gives 0 where nothing is left to do (--help was printed). Throws base::InputError.
std::optional<int> ParseCommandLine(int argc, char** argv, CommandLine& out);

}  // namespace alula::scenarios::internal
