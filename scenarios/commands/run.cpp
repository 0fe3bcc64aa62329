#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/error.h"
#include "scenarios/commands/flight.h"
#include "scenarios/commands/verbs.h"
#include "scenarios/dataset/dataset_recorder.h"
#include "scenarios/exit_codes.h"
#include "scenarios/junit.h"
#include "scenarios/report/video_recorder.h"
#include "scenarios/write_file.h"

namespace alula::scenarios::commands {
namespace fs = std::filesystem;
namespace {

/// Everything that `run` writes besides the run folder.
struct Results {
  std::vector<std::string> json;
  std::vector<JunitCase> junit;
};

int FlyOne(const Scenario& scenario, const fs::path& out, const CommandLine& line, Results& results) {
  RunOptions options = OptionsOf(line);
  options.out = out;
  if (line.video) {
    options.spectators.push_back(FilmTheRun(scenario.name + ", seed " + std::to_string(scenario.seed)));
  }
  if (line.dataset) {
    options.spectators.push_back(dataset::RecordDataset({*line.dataset, scenario.name, scenario.seed, std::nullopt},
                                                        std::make_shared<dataset::DatasetSize>()));
  }
  const FlightEnd end = Fly(scenario, options, line);
  if (!end.verdict) return end.exit_code;
  const Verdict& verdict = *end.verdict;
  results.json.push_back(ToJson(verdict));
  const std::vector<JunitCase> cases = JunitCases(verdict, end.wall_s);
  results.junit.insert(results.junit.end(), cases.begin(), cases.end());
  if (line.json == "-") return end.exit_code;
  if (line.quiet || line.all) {
    std::printf("%s: %s (%s)\n", scenario.name.c_str(), Word(verdict.outcome), verdict.reason.c_str());
  } else {
    std::printf("%s  files in %s\n", ToTable(verdict).c_str(), out.c_str());
  }
  std::fflush(stdout);
  return end.exit_code;
}

std::string JsonOf(const Results& results, bool many) {
  if (!many) return results.json.empty() ? "" : results.json.front();
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const std::string& text : results.json) all.push_back(nlohmann::ordered_json::parse(text));
  return all.dump(2) + "\n";
}

void WriteResults(const Results& results, const CommandLine& line) {
  if (!line.json.empty() && (line.all || !results.json.empty())) {
    WriteFile("--json", line.json, JsonOf(results, line.all));
  }
  if (!line.junit.empty() && !results.junit.empty()) WriteFile("--junit", line.junit, JunitXml(results.junit));
}

bool HasTag(const Scenario& scenario, const std::string& tag) {
  const std::vector<std::string>& tags = scenario.config.tags;
  return tag.empty() || std::find(tags.begin(), tags.end(), tag) != tags.end();
}

/// Of several exit codes the one that says most: interrupted, then a fault, then bad input, then a failure.
int Worse(int a, int b) {
  const auto weight = [](int code) {
    return code == kExitInterrupted ? 4
           : code == kExitFault     ? 3
           : code == kExitBadInput  ? 2
           : code == kExitFailed    ? 1
                                    : 0;
  };
  return weight(a) >= weight(b) ? a : b;
}

int RunAll(const CommandLine& line) {
  std::vector<Scenario> scenarios;
  for (const fs::path& file : ListScenarios()) {
    Scenario scenario = LoadScenario(file, line.overrides, line.seed);
    if (HasTag(scenario, line.tag)) scenarios.push_back(std::move(scenario));
  }
  if (scenarios.empty()) throw base::InputError("--tag " + line.tag + ": no scenario of the catalog has this tag");
  Results results;
  int worst = kExitPassed;
  for (const Scenario& scenario : scenarios) {
    const fs::path folder = line.out ? *line.out : fs::path("runs");
    worst = Worse(worst, FlyOne(scenario, folder / scenario.name / std::to_string(scenario.seed), line, results));
    if (worst == kExitInterrupted) break;
  }
  WriteResults(results, line);
  return worst;
}

}  // namespace

int Run(const CommandLine& line) {
  if (line.all) return RunAll(line);
  const Scenario scenario = LoadScenario(FindScenario(line.names.front()), line.overrides, line.seed);
  const fs::path out = line.out ? *line.out : fs::path("runs") / scenario.name / std::to_string(scenario.seed);
  Results results;
  const int exit_code = FlyOne(scenario, out, line, results);
  WriteResults(results, line);
  return exit_code;
}

int Export(const CommandLine& line) {
  const Scenario scenario = LoadScenario(FindScenario(line.names.front()), line.overrides, line.seed);
  RunOptions options = OptionsOf(line);
  const fs::path folder = line.out ? *line.out : fs::path("datasets") / scenario.name / std::to_string(scenario.seed);
  const auto size = std::make_shared<dataset::DatasetSize>();
  options.spectators.push_back(dataset::RecordDataset({*line.dataset, scenario.name, scenario.seed, folder}, size));
  const FlightEnd end = Fly(scenario, options, line, [&size](const std::function<void()>&) {
    return fmt::format("{:.1f} s, {} images, {} depth images, {} inertial samples", size->span.Seconds(), size->images,
                       size->depth_images, size->imu_samples);
  });
  if (!end.verdict) return end.exit_code;
  const std::string what = end.note.empty() ? "nothing was written" : end.note + " in " + folder.string();
  std::printf("%s: %s (%s: %s)\n", scenario.name.c_str(), what.c_str(), Word(end.verdict->outcome),
              end.verdict->reason.c_str());
  return end.exit_code;
}

}  // namespace alula::scenarios::commands
