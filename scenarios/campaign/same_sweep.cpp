#include "scenarios/campaign/same_sweep.h"

#include <algorithm>
#include <set>

#include "base/error.h"
#include "scenarios/campaign/executor.h"

namespace alula::scenarios::campaign {
namespace {

/// Where two texts part: the lines of both.
std::string FirstOtherLine(const std::string& before, const std::string& now) {
  const auto [a, b] = std::mismatch(before.begin(), before.end(), now.begin(), now.end());
  const auto line = [](const std::string& text, std::string::const_iterator at) -> std::string {
    if (at == text.end()) return "nothing";
    const std::size_t position = static_cast<std::size_t>(at - text.begin());
    const std::size_t newline = text.rfind('\n', position == 0 ? 0 : position - 1);
    const std::size_t begin = newline == std::string::npos ? 0 : newline + 1;
    const std::size_t first = text.find_first_not_of(' ', begin);
    return "`" + text.substr(first, text.find('\n', first) - first) + "`";
  };
  return line(before, a) + " before, " + line(now, b) + " now";
}

std::string FolderOf(const Database& database) { return database.file().parent_path().string(); }

constexpr const char* kMend = "name another --out, or begin again with --fresh";

}  // namespace

void CheckSameProgram(Database& database, const std::string& scenario) {
  if (database.Seeds().empty()) {
    database.SetFact("program", ProgramHash());
    database.SetFact("scenario", scenario);
  } else if (database.Fact("program") != ProgramHash()) {
    throw base::InputError(FolderOf(database) +
                           ": holds runs of another build of Alula, which would not be one sample with new ones; " +
                           kMend);
  }
}

void CheckSameCase(const Database& database, const Case& now) {
  const std::optional<Row> then = database.Find(now.seed);
  if (then->scenario_yaml == now.scenario_yaml) return;
  throw base::InputError(FolderOf(database) + ": holds runs of another scenario or plan (seed " +
                         std::to_string(now.seed) +
                         " would differ: " + FirstOtherLine(then->scenario_yaml, now.scenario_yaml) + "); " + kMend);
}

void CheckSameSweep(Database& database, const CaseMaker& cases) {
  const std::set<std::uint64_t> there = database.Seeds();
  CheckSameProgram(database, cases.name());
  constexpr std::size_t kLooks = 5;  // a plan or scenario that changed changes all runs, or nearly all
  std::size_t looks = 0;
  for (std::size_t i = 0; i < cases.plan().seeds.size() && looks < kLooks; ++i) {
    if (!there.contains(cases.plan().seeds[i])) continue;
    ++looks;
    CheckSameCase(database, cases.Make(i));
  }
}

}  // namespace alula::scenarios::campaign
