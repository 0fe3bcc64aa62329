#include "scenarios/campaign/slurm/batch_script.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <sstream>

#include "base/error.h"
#include "base/hash.h"

namespace alula::scenarios::slurm {

namespace {

/// Slurm checks limits every 30 s and sends this signal up to a minute early; a task that got it at its start would do
/// nothing at all.
constexpr int kWarningSeconds = 30;
constexpr int kShortestLimitMinutes = 3;

/// What a user's option may not replace: the sweep would no longer find, wait for or restart its tasks.
constexpr std::array<std::string_view, 14> kOwn = {
    "--array",  "--clusters",  "--error",  "--export",   "--export-file", "--job-name", "--no-requeue",
    "--ntasks", "--open-mode", "--output", "--parsable", "--requeue",     "--wait",     "--wrap"};

std::string_view KeyOf(std::string_view option) { return option.substr(0, option.find_first_of("= ")); }

bool HasLineBreak(std::string_view text) { return text.find_first_of(std::string_view("\n\r\0", 3)) != text.npos; }

void CheckText(std::string_view what, std::string_view text) {
  if (HasLineBreak(text)) {
    throw base::InputError(std::string(what) + ": a line break cannot stand in a batch script; name it without");
  }
}

/// One line of #SBATCH may hold several options, so each word of it is looked at.
void CheckOption(const std::string& option) {
  CheckText("--slurm-option", option);
  std::istringstream words(option);
  std::string word;
  for (bool first = true; words >> word; first = false) {
    if (!first && word.front() != '-') continue;
    if (!word.starts_with("--") || word.size() == 2) {
      throw base::InputError("--slurm-option '" + option + "': '" + word + "' is no option of sbatch in its long " +
                             "form; write such as --partition=short");
    }
    // sbatch takes any beginning of an option's name that is unique ("--arr=0-3").
    const std::string_view key = KeyOf(word);
    const auto* const own = std::find_if(kOwn.begin(), kOwn.end(), [key](auto o) { return o.starts_with(key); });
    if (own != kOwn.end()) {
      throw base::InputError("--slurm-option '" + option + "': the sweep sets " + std::string(*own) +
                             " itself; leave it out");
    }
  }
  if (word.empty()) throw base::InputError("--slurm-option: empty; write such as --partition=short");
}

void Check(const SlurmJob& job) {
  if (job.shards.empty()) throw base::FaultError("slurm", "a job without shards");
  if (!job.folder.is_absolute() || !job.binary.is_absolute()) {
    throw base::FaultError("slurm", "a batch script needs absolute paths");
  }
  CheckText("--out", job.folder.native());
  CheckText("the path of alula", job.binary.native());
  CheckText("the job's name", job.name);
  // Slurm takes a backslash anywhere in the name of a log for "no patterns here" and drops it.
  if (job.folder.native().find('\\') != std::string::npos) {
    throw base::InputError("--out " + job.folder.string() + ": Slurm cannot write logs below a folder with a " +
                           "backslash in its name; name another");
  }
  if (job.time_limit_minutes && *job.time_limit_minutes < kShortestLimitMinutes) {
    throw base::InputError("a time limit of " + std::to_string(*job.time_limit_minutes) +
                           " min: Slurm warns of it up to 90 s early, so a task would get nowhere; give " +
                           std::to_string(kShortestLimitMinutes) + " min or more");
  }
  for (const std::string& option : job.options) CheckOption(option);
}

/// A value for a line of #SBATCH, which knows double quotes and the backslash as a shell does, but no variables.
std::string DirectiveQuoted(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '\\';
    quoted += c;
  }
  return quoted + '"';
}

/// "%" begins a pattern in the name of a log.
std::string WithoutPatterns(std::string_view text) {
  std::string plain;
  for (const char c : text) plain += c == '%' ? std::string("%%") : std::string(1, c);
  return plain;
}

bool UserSets(const SlurmJob& job, std::initializer_list<std::string_view> keys) {
  return std::any_of(job.options.begin(), job.options.end(), [keys](const std::string& option) {
    return std::find(keys.begin(), keys.end(), KeyOf(option)) != keys.end();
  });
}

std::string Directives(const SlurmJob& job) {
  std::string lines;
  const auto add = [&lines](const std::string& option) { lines += "#SBATCH " + option + "\n"; };
  add("--job-name=" + DirectiveQuoted(job.name));
  add("--array=" + ArrayExpression(job.shards) + (job.tasks_at_once ? "%" + std::to_string(*job.tasks_at_once) : ""));
  add("--output=" + DirectiveQuoted(WithoutPatterns(LogFolder(job.folder).native()) + "/%A_%a.log"));
  add("--open-mode=append");
  add("--requeue");
  if (!UserSets(job, {"--signal"})) add("--signal=B:TERM@" + std::to_string(kWarningSeconds));
  add("--export=ALL");
  add("--ntasks=1");
  if (!UserSets(job, {"--cpus-per-task"})) add("--cpus-per-task=" + std::to_string(job.cpus_per_task));
  if (job.memory_mb && !UserSets(job, {"--mem", "--mem-per-cpu", "--mem-per-gpu"})) {
    add("--mem=" + std::to_string(*job.memory_mb) + "M");
  }
  if (job.time_limit_minutes && !UserSets(job, {"--time"})) add("--time=" + std::to_string(*job.time_limit_minutes));
  for (const std::string& option : job.options) add(option);
  return lines;
}

bool IsVariableName(std::string_view name) {
  return !name.empty() && std::isdigit(static_cast<unsigned char>(name.front())) == 0 &&
         std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
}

std::string Environment(const SlurmJob& job) {
  std::string lines = "export LC_ALL=C\n";
  for (const auto& [name, value] : job.environment) {
    if (!IsVariableName(name)) throw base::FaultError("slurm", "not a name of a variable: " + name);
    lines += "export " + name + "=" + ShellQuoted(value) + "\n";
  }
  return lines;
}

}  // namespace

std::filesystem::path LogFolder(const std::filesystem::path& folder) { return folder / "slurm"; }

std::string JobName(const std::filesystem::path& folder) {
  const std::filesystem::path path = std::filesystem::weakly_canonical(std::filesystem::absolute(folder));
  constexpr std::size_t kLongestPart = 40;  // squeue is asked by the whole name; a person reads its beginning
  std::string part = (path.has_filename() ? path : path.parent_path()).filename().string().substr(0, kLongestPart);
  for (char& c : part) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '_' && c != '-' && c != '.') c = '_';
  }
  base::RollingHash hash;
  hash.Add(std::string_view(path.native()));
  return "alula-" + part + "-" + hash.Hex().substr(0, 8);
}

std::string ArrayExpression(std::vector<int> numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  std::string text;
  for (std::size_t i = 0; i < numbers.size();) {
    std::size_t last = i;
    while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
    if (!text.empty()) text += ',';
    text += std::to_string(numbers[i]);
    if (last > i) text += '-' + std::to_string(numbers[last]);
    i = last + 1;
  }
  return text;
}

std::string ShellQuoted(std::string_view text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string BatchScript(const SlurmJob& job) {
  Check(job);
  return "#!/bin/bash\n" + Directives(job) +
         "\n"
         "# Shard by shard of a sweep; a task that runs again goes on where the last one stopped.\n" +
         Environment(job) + "exec " + ShellQuoted(job.binary.native()) + " sweep --worker " +
         ShellQuoted(job.folder.native()) + " --shard \"$SLURM_ARRAY_TASK_ID\"\n";
}

}  // namespace alula::scenarios::slurm
