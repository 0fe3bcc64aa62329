#include "scenarios/replay/run_case.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/error.h"

namespace alula::scenarios::replay {
namespace {

nlohmann::json ReadVerdict(const std::filesystem::path& file) {
  std::ifstream stream(file);
  nlohmann::json json = nlohmann::json::parse(stream, nullptr, /*allow_exceptions=*/false);
  if (!json.is_object()) throw base::InputError(file.string() + ": is no verdict; was the run killed?");
  return json;
}

std::string Text(const nlohmann::json& json, const char* key, const std::filesystem::path& file) {
  const auto found = json.find(key);
  if (found == json.end() || !found->is_string()) {
    throw base::InputError(file.string() + ": " + key + ": is missing; must be a text");
  }
  return found->get<std::string>();
}

}  // namespace

RunCase CaseOfFolder(const std::filesystem::path& folder, RunOptions options) {
  const std::filesystem::path scenario = folder / "scenario.yaml", verdict = folder / "verdict.json";
  for (const std::filesystem::path& file : {scenario, verdict}) {
    if (!std::filesystem::is_regular_file(file)) {
      throw base::InputError(folder.string() + ": is no run folder: it has no " + file.filename().string());
    }
  }
  RunCase run{LoadScenario(scenario, {}, std::nullopt), std::move(options), Recorded{}};
  const nlohmann::json json = ReadVerdict(verdict);
  run.scenario.name = Text(json, "scenario", verdict);
  run.recorded->digest = Text(json, "digest", verdict);
  run.recorded->numeric_class = Text(json, "numeric_class", verdict);
  const std::filesystem::path digests = folder / sim::kDigestsFile;
  if (std::filesystem::exists(digests)) run.recorded->rows = sim::ReadDigests(digests);
  return run;
}

}  // namespace alula::scenarios::replay
