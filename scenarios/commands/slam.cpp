#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "base/error.h"
#include "scenarios/campaign/case.h"
#include "scenarios/commands/flight.h"
#include "scenarios/commands/verbs.h"
#include "scenarios/dataset/layouts.h"
#include "scenarios/exit_codes.h"
#include "scenarios/progress.h"
#include "scenarios/slam/flight_feed.h"
#include "scenarios/slam/recording_feed.h"
#include "scenarios/slam/slam_report.h"
#include "scenarios/slam/train_vocabulary.h"
#include "scenarios/slam/variants.h"
#include "scenarios/write_file.h"
#include "stack/slam/map_file.h"

namespace alula::scenarios::commands {
namespace fs = std::filesystem;
namespace {

fs::path FolderOf(const CommandLine& line, const std::string& name, std::uint64_t seed) {
  const fs::path all = line.out ? *line.out : fs::path("runs") / "slam" / fs::path(name).filename();
  return all / std::to_string(seed);
}

std::vector<slam::Variant> Variants(const fs::path& scenario, const CommandLine& line, std::uint64_t seed) {
  std::vector<slam::Variant> variants = slam::VariantsOf(scenario, line.overrides, line.variants, seed);
  if (!line.load_map.empty()) stack::slam::LoadMap(line.load_map);  // says at once what is wrong with it
  for (slam::Variant& variant : variants) {
    variant.known_map = line.load_map;
    variant.keeps_map = line.save_map;
  }
  return variants;
}

/// One flight, rendered once, in a process of its own; its report comes back as text.
int WatchFlight(const fs::path& file, std::uint64_t seed, const CommandLine& line, nlohmann::ordered_json& all) {
  const Scenario scenario = LoadScenario(file, line.overrides, seed);
  const auto feed = std::make_shared<slam::FlightFeed>();
  feed->variants = Variants(file, line, seed);
  RunOptions options = OptionsOf(line);
  options.stack = slam::FeedEstimators(feed);
  options.spectators.push_back(slam::NoteTruth(feed));
  const FlightEnd end = Fly(scenario, options, line, [&](const std::function<void()>& alive) {
    std::vector<slam::EstimatorResult> results;
    for (slam::EstimatorRun& run : feed->runs) {
      results.push_back(run.Finish());
      alive();
    }
    const slam::SlamReport report = slam::Judge(scenario.name, seed, std::move(results), feed->truth);
    slam::WriteFiles(report, FolderOf(line, scenario.name, seed));
    return slam::ToJson(report).dump();
  });
  if (!end.verdict) return end.exit_code;
  if (end.note.empty()) {
    std::fprintf(stderr, "%s: %s\n", scenario.name.c_str(), end.verdict->reason.c_str());
    return kExitFault;
  }
  const auto report = nlohmann::ordered_json::parse(end.note);
  if (line.json != "-") std::fputs(slam::ToTable(report).c_str(), stdout);
  std::fflush(stdout);
  all.push_back(report);
  return kExitPassed;
}

int WatchRecording(const fs::path& folder, const CommandLine& line, nlohmann::ordered_json& all) {
  const dataset::Recording recording =
      dataset::OpenRecording(folder, line.camera_yaml.empty() ? std::nullopt : std::optional(line.camera_yaml));
  const std::string name = fs::canonical(folder).filename().string();
  const std::vector<slam::Variant> variants = Variants({}, line, 1);
  Progress progress(name, slam::SpanOf(recording), line.talks());
  std::vector<slam::EstimatorResult> results =
      slam::FeedRecording(recording, variants, [&progress](base::Time time) { progress.Show(time); });
  progress.Clear();
  const slam::SlamReport report = slam::Judge(name, 1, std::move(results), slam::TruthOf(recording));
  slam::WriteFiles(report, line.out ? *line.out : fs::path("runs") / "slam" / name);
  const nlohmann::ordered_json json = slam::ToJson(report);
  if (line.json != "-") std::fputs(slam::ToTable(json).c_str(), stdout);
  all.push_back(json);
  return kExitPassed;
}

}  // namespace

int Slam(const CommandLine& line) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  int worst = kExitPassed;
  for (const std::string& name : line.names) {
    if (fs::is_directory(name)) {
      worst = std::max(worst, WatchRecording(name, line, all));
      continue;
    }
    const fs::path file = FindScenario(name);
    std::vector<std::uint64_t> seeds;
    if (!line.sweep.seeds.empty()) seeds = campaign::ParseSeeds(line.sweep.seeds);
    if (seeds.empty()) seeds.push_back(LoadScenario(file, line.overrides, line.seed).seed);
    for (const std::uint64_t seed : seeds) {
      const int code = WatchFlight(file, seed, line, all);
      if (code == kExitInterrupted) return code;
      worst = std::max(worst, code);
    }
  }
  if (!line.json.empty()) WriteFile("--json", line.json, all.dump(2) + "\n");
  return worst;
}

int TrainVocabulary(const CommandLine& line) {
  slam::VocabularyTraining training;
  training.render = line.render;
  const std::size_t bytes = slam::WriteVocabulary(training, *line.out, [&line](int done, int of) {
    if (line.talks()) std::fprintf(stderr, "%d of %d worlds drawn\n", done, of);
  });
  std::printf("%s: %zu bytes\n", line.out->c_str(), bytes);
  return kExitPassed;
}

}  // namespace alula::scenarios::commands
