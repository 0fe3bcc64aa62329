#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/core/utility.hpp>
#include <string>

#include "base/error.h"
#include "base/nearest.h"
#include "bench/bench.h"
#include "scenarios/check/sensor_checks.h"
#include "scenarios/dataset/dataset_recorder.h"
#include "scenarios/environment.h"
#include "scenarios/internal/cli.h"
#include "scenarios/progress.h"
#include "scenarios/report/video_recorder.h"
#include "scenarios/runner.h"
#include "scenarios/scenario.h"
#include "sim/run_folder.h"

namespace alula::scenarios {
namespace {

using internal::CommandLine;

constexpr int kFailed = 1, kBadInput = 2, kFault = 3, kInterrupted = 130;

std::atomic<bool> interrupted{false};

/// The first Ctrl-C ends the run cleanly; a second one kills the program as it would any.
void CatchInterrupts() {
  struct sigaction action = {};
  action.sa_handler = [](int) { interrupted.store(true, std::memory_order_relaxed); };
  action.sa_flags = SA_RESETHAND;
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
}

/// What run and export share.
RunOptions OptionsOf(const CommandLine& line) {
  RunOptions options;
  options.workers = line.workers;
  options.render = line.render;
  options.interrupt = &interrupted;
  return options;
}

/// Flies with a progress bar.
Verdict Fly(const Scenario& scenario, RunOptions& options, bool show) {
  Progress progress(scenario.name, LimitOf(scenario.config), show);
  options.progress = [&progress](base::Time time) { progress.Show(time); };
  CatchInterrupts();
  Verdict verdict = RunScenario(scenario, options);
  progress.Clear();
  options.progress = nullptr;
  if (verdict.versions.at("cpu") != "avx2+fma") {
    std::fprintf(stderr,
                 "note: this processor lacks AVX2 or FMA; digests differ from those of processors that have them\n");
  }
  return verdict;
}

int Run(const CommandLine& line) {
  const Scenario scenario = LoadScenario(FindScenario(line.names.front()), line.overrides, line.seed);
  RunOptions options = OptionsOf(line);
  options.out = line.out ? *line.out : std::filesystem::path("runs") / scenario.name / std::to_string(scenario.seed);
  if (line.video) {
    options.spectators.push_back(FilmTheRun(scenario.name + ", seed " + std::to_string(scenario.seed)));
  }
  if (line.dataset) {
    options.spectators.push_back(dataset::RecordDataset({*line.dataset, scenario.name, scenario.seed, std::nullopt},
                                                        std::make_shared<dataset::DatasetSize>()));
  }
  const Verdict verdict = Fly(scenario, options, !line.quiet && !line.json);
  const std::string table = ToTable(verdict);
  if (line.json) {
    std::fputs(ToJson(verdict).c_str(), stdout);
  } else if (line.quiet) {
    std::printf("%s: %s (%s)\n", scenario.name.c_str(), Word(verdict.outcome), verdict.reason.c_str());
  } else {
    std::printf("%s  files in %s\n", table.c_str(), options.out->c_str());
  }
  return ExitCode(verdict.outcome);
}

int Export(const CommandLine& line) {
  const Scenario scenario = LoadScenario(FindScenario(line.names.front()), line.overrides, line.seed);
  RunOptions options = OptionsOf(line);
  const std::filesystem::path folder =
      line.out ? *line.out : std::filesystem::path("datasets") / scenario.name / std::to_string(scenario.seed);
  const auto size = std::make_shared<dataset::DatasetSize>();
  options.spectators.push_back(dataset::RecordDataset({*line.dataset, scenario.name, scenario.seed, folder}, size));
  const Verdict verdict = Fly(scenario, options, !line.quiet);
  std::printf("%s: %.1f s, %lld images, %lld depth images, %lld inertial samples in %s (%s: %s)\n",
              scenario.name.c_str(), size->span.Seconds(), static_cast<long long>(size->images),
              static_cast<long long>(size->depth_images), static_cast<long long>(size->imu_samples), folder.c_str(),
              Word(verdict.outcome), verdict.reason.c_str());
  return ExitCode(verdict.outcome);
}

int List(const CommandLine& line) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const CatalogEntry& entry : ListCatalogs()) {
    const std::string meaning =
        entry.kind == "scenario" ? LoadScenario(entry.file, {}, std::nullopt).config.meaning : std::string();
    json.push_back({{"kind", entry.kind}, {"name", entry.name}, {"meaning", meaning}});
    if (!line.json) std::printf("%-10s%-20s %s\n", entry.kind.c_str(), entry.name.c_str(), meaning.c_str());
  }
  if (line.json) std::printf("%s\n", json.dump(2).c_str());
  return 0;
}

int CheckFiles(const CommandLine& line) {
  for (const std::string& name : line.names) {
    const CatalogEntry entry = FindAny(name);
    const std::uint64_t seed = line.seed.value_or(1);
    if (entry.kind == "vehicle") {
      MakeVehicle(LoadVehicle(entry.file, line.overrides, seed), "vehicle0");
    } else if (entry.kind == "world") {
      MakeWorld(LoadWorld(entry.file, line.overrides, seed), seed);
    } else {
      TryToBuild(LoadScenario(entry.file, line.overrides, line.seed));
    }
    if (!line.quiet) std::printf("%s: good\n", entry.file.c_str());
  }
  return 0;
}

int CheckSensors(const CommandLine& line) {
  const Scenario scenario = LoadScenario(FindScenario(line.names.front()), line.overrides, line.seed);
  const bool terminal = ::isatty(STDERR_FILENO) != 0;
  const auto told = [terminal](const std::string& what) {
    if (terminal) std::fprintf(stderr, "\r%-70s", what.c_str());
  };
  check::Rig rig;
  rig.sensors = scenario.config.sensors;
  rig.body = MakeVehicle(scenario.config.vehicle, check::kVehicle)->body();
  rig.step = scenario.config.simulation.step;
  rig.seed = scenario.seed;
  rig.render = line.render;
  const check::Report report = check::CheckSensors(rig, scenario.config.sensors, told);
  if (terminal) std::fprintf(stderr, "\r%-70s\r", "");
  std::fputs((line.json ? check::ToJson(report, scenario.name) : check::ToTable(report)).c_str(), stdout);
  return report.passed() ? 0 : kFailed;
}

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
  const int exit_code = figures.failed ? kFailed : 0;
  if (line.json_file.empty()) return exit_code;
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const auto& [key, value] : figures.values) json[key] = value;
  const std::filesystem::path partial = line.json_file.string() + ".partial";
  std::ofstream file(partial);
  file << json.dump(2) << '\n';
  file.close();
  std::error_code error;
  if (file) std::filesystem::rename(partial, line.json_file, error);
  if (!file || error) throw base::InputError("--json: cannot write " + line.json_file.string());
  return exit_code;
}

int Main(int argc, char** argv) {
  CommandLine line;
  if (const std::optional<int> done = internal::ParseCommandLine(argc, argv, line)) return *done;
  switch (line.verb) {
    case CommandLine::Verb::kRun:
      return Run(line);
    case CommandLine::Verb::kExport:
      return Export(line);
    case CommandLine::Verb::kList:
      return List(line);
    case CommandLine::Verb::kCheck:
      return CheckFiles(line);
    case CommandLine::Verb::kCheckSensors:
      return CheckSensors(line);
    case CommandLine::Verb::kBench:
      return Bench(line);
  }
  return kFault;
}

}  // namespace
}  // namespace alula::scenarios

int main(int argc, char** argv) {
  using namespace alula;
  scenarios::FixEnvironment(argv);
  cv::setNumThreads(1);
  try {
    return scenarios::Main(argc, argv);
  } catch (const base::InputError& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return scenarios::kBadInput;
  } catch (const scenarios::Interrupted&) {
    std::fprintf(stderr, "\ninterrupted: nothing was written\n");
    return scenarios::kInterrupted;
  } catch (const base::FaultError& e) {
    std::fprintf(stderr, "fault (%s): %s\n", e.reason().c_str(), e.what());
    return scenarios::kFault;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "fault: %s\n", e.what());
    return scenarios::kFault;
  }
}
