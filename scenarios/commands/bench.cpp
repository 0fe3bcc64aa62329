#include "bench/bench.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/nearest.h"
#include "scenarios/commands/verbs.h"
#include "scenarios/exit_codes.h"
#include "scenarios/write_file.h"

namespace alula::scenarios::commands {

int Bench(const CommandLine& line) {
  std::vector<std::string> known;
  for (const bench::Benchmark& benchmark : bench::Benchmarks()) known.emplace_back(benchmark.name);
  for (const std::string& name : line.names) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    throw base::InputError("no benchmark is called '" + name + "'; " + base::Suggestion(name, known, "benchmarks"));
  }
  bench::Figures figures;
  for (const bench::Benchmark& benchmark : bench::Benchmarks()) {
    const bool wanted = std::find(line.names.begin(), line.names.end(), benchmark.name) != line.names.end();
    if (line.names.empty() || wanted) benchmark.run(figures);
  }
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const auto& [key, value] : figures.values) json[key] = value;
  if (!line.json.empty()) WriteFile("--json", line.json, json.dump(2) + "\n");
  return figures.failed ? kExitFailed : kExitPassed;
}

}  // namespace alula::scenarios::commands
