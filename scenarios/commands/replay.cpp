#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>

#include "base/error.h"
#include "scenarios/campaign/database.h"
#include "scenarios/commands/flight.h"
#include "scenarios/commands/verbs.h"
#include "scenarios/exit_codes.h"
#include "scenarios/replay/first_difference.h"
#include "scenarios/report/video_recorder.h"
#include "scenarios/write_file.h"
#include "sim/interval_digests.h"
#include "sim/run_folder.h"

namespace alula::scenarios::commands {
namespace fs = std::filesystem;
namespace {

using replay::RunCase;

RunCase CaseOfRow(const fs::path& file, const std::string& seed, RunOptions options) {
  const std::string name = file.string() + "#" + seed;
  const bool digits = !seed.empty() && seed.size() <= 18 && seed.find_first_not_of("0123456789") == std::string::npos;
  if (!digits) throw base::InputError(name + ": a seed is wanted after the #, as in sweep.db#137");
  const std::optional<campaign::Row> row =
      campaign::Database(file, campaign::Database::Mode::kRead).Find(std::stoull(seed));
  if (!row) throw base::InputError(name + ": the sweep has no run of this seed");
  const base::YamlDocument document = base::YamlDocument::Parse(row->scenario_yaml, name, Catalogs());
  RunCase run{ResolveScenario(document, row->verdict.scenario, std::nullopt), std::move(options), replay::Recorded{}};
  run.recorded->digest = row->verdict.digest;
  run.recorded->numeric_class = row->verdict.numeric_class;
  if (!row->interval_digests.empty()) run.recorded->rows = sim::ParseDigests(row->interval_digests, name);
  return run;
}

/// A run folder, or "sweep.db#137".
RunCase CaseOf(const std::string& text, const CommandLine& line) {
  const std::size_t hash = text.rfind('#');
  if (hash != std::string::npos) return CaseOfRow(text.substr(0, hash), text.substr(hash + 1), OptionsOf(line));
  if (fs::is_regular_file(text)) {
    throw base::InputError(text + ": is a file; name a run folder, or a run of a sweep as " + text + "#137");
  }
  return replay::CaseOfFolder(text, OptionsOf(line));
}

int Diff(const CommandLine& line) {
  if (line.names.size() != 2) throw base::InputError("replay: --diff wants two runs");
  RunCase a = CaseOf(line.names[0], line), b = CaseOf(line.names[1], line);
  // Stacks fly here: what a library does to its process must not end in silence.
  const Ending ending = Supervise(line.limits, [&](Pulse& pulse) {
    Report report;
    report.exit_code = Guarded([&] {
      a.options.pulse = b.options.pulse = &pulse.simulated_ns;
      const replay::RunComparison comparison = replay::CompareRuns(a, b);
      if (line.json != "-") std::fputs(replay::ToText(comparison).c_str(), stdout);
      if (!line.json.empty()) WriteFile("--json", line.json, replay::ToJson(comparison));
      return comparison.first ? kExitFailed : kExitPassed;
    });
    return report;
  });
  if (ending.interrupted) return kExitInterrupted;
  if (ending.death) throw base::FaultError(ending.death->reason, ending.death->message);
  return ending.report.exit_code;
}

/// When the rows of two runs first differ, as "from 4 s to 5 s"; empty where they do not.
std::string FirstOtherInterval(const std::vector<sim::DigestRow>& a, const std::vector<sim::DigestRow>& b) {
  for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i) {
    if (i < a.size() && i < b.size() && a[i] == b[i]) continue;
    const double begin = i == 0 ? 0.0 : (i <= a.size() ? a : b)[i - 1].time.Seconds();
    const double end = (i < a.size() ? a : b)[i].time.Seconds();
    char text[64];
    std::snprintf(text, sizeof text, "between %g s and %g s", begin, end);
    return text;
  }
  return {};
}

struct Judgement {
  bool same = false;
  std::string text;
};

/// The digest of a run that died is not known; that it dies again is all that can be said.
Judgement Judge(const replay::Recorded& recorded, const Verdict& verdict, const fs::path& folder) {
  if (recorded.digest.empty()) {
    const bool died_again = verdict.digest.empty();
    return {died_again, died_again ? "it died again: " + verdict.message : "the recorded run died, this one did not"};
  }
  if (recorded.digest == verdict.digest) return {true, "the same run: digest " + verdict.digest};
  std::string text = "another run: digest " + verdict.digest + ", recorded " + recorded.digest;
  const fs::path file = folder / sim::kDigestsFile;
  if (!recorded.rows.empty() && fs::exists(file)) {
    const std::string interval = FirstOtherInterval(recorded.rows, sim::ReadDigests(file));
    if (!interval.empty()) text += "; they part " + interval;
  }
  if (recorded.numeric_class != verdict.numeric_class) {
    text += "\n  recorded in numeric class " + recorded.numeric_class + "\n  this one is      " + verdict.numeric_class;
  }
  return {false, text};
}

}  // namespace

int Replay(const CommandLine& line) {
  if (line.diff) return Diff(line);
  if (line.names.size() != 1) throw base::InputError("replay: takes one run; --diff takes two");
  RunCase run = CaseOf(line.names.front(), line);
  const Scenario& scenario = run.scenario;
  run.options.out = line.out ? *line.out : fs::path("replay") / scenario.name / std::to_string(scenario.seed);
  if (line.video) {
    run.options.spectators.push_back(FilmTheRun(scenario.name + ", seed " + std::to_string(scenario.seed)));
  }
  const FlightEnd end = Fly(scenario, run.options, line);
  if (!end.verdict) return end.exit_code;
  const Judgement judgement = Judge(*run.recorded, *end.verdict, *run.options.out);
  if (line.json != "-") {
    if (!line.quiet) std::printf("%s  files in %s\n", ToTable(*end.verdict).c_str(), run.options.out->c_str());
    std::printf("%s\n", judgement.text.c_str());
  }
  if (!line.json.empty()) {
    const nlohmann::ordered_json json = {{"same", judgement.same},
                                         {"digest", end.verdict->digest},
                                         {"recorded_digest", run.recorded->digest},
                                         {"text", judgement.text}};
    WriteFile("--json", line.json, json.dump(2) + "\n");
  }
  return judgement.same ? kExitPassed : kExitFailed;
}

}  // namespace alula::scenarios::commands
