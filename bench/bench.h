#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace alula::bench {

/// What a benchmark found: keys `<bench>/<map or world>/<planner, maker or part>/<what>_<unit>`, in the order found.
struct Figures {
  std::vector<std::pair<std::string, double>> values;
  /// Plain lines for a person, printed as they come.
  void Add(std::string key, double value);
  /// A figure that breaks a promise of the design: printed, and the verb exits with 1.
  void Fail(const std::string& what);
  bool failed = false;
};

struct Benchmark {
  std::string_view name;
  void (*run)(Figures&);
};

/// Every file bench/NAME_bench.cpp defines `void alula::bench::Run_NAME(Figures&)`
/// (`dynamics_bench.cpp`: `Run_dynamics`); CMake collects them into this table.
std::span<const Benchmark> Benchmarks();

}  // namespace alula::bench
