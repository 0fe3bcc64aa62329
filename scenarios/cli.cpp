#include "scenarios/internal/cli.h"

#include <CLI/CLI.hpp>

#include "base/error.h"

namespace alula::scenarios::internal {
namespace {

struct Raw {
  std::string name;
  std::vector<std::string> sets;
  std::uint64_t seed = 0;
  std::string out;
  std::string format = "euroc";
};

const CLI::IsMember kFormats({"euroc", "tum"});

base::Override ParseOverride(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw base::InputError("--set " + text + ": must be path.to.key=value");
  }
  return {text.substr(0, equals), text.substr(equals + 1)};
}

void AddRender(CLI::App& verb, CommandLine& line) {
  verb.add_option("--render", line.render,
                  "who draws the pictures: osmesa, egl, raster (our own, on the processor) or auto")
      ->check(CLI::IsMember({"auto", "osmesa", "egl", "raster"}));
}

/// What all verbs that fly a scenario understand.
void AddFlight(CLI::App& verb, CommandLine& line, Raw& raw) {
  verb.add_option("scenario", raw.name, "a name of the catalog ('alula list') or a YAML file")->required();
  verb.add_option("--seed", raw.seed, "of all random numbers (default: the scenario's, else 1)");
  verb.add_option("--set", raw.sets, "path.to.key=value: override any key (may be repeated)")->take_all();
  verb.add_option("--workers", line.workers, "threads inside the run; they change no result")->check(CLI::Range(1, 64));
  AddRender(verb, line);
}

CLI::App* AddRun(CLI::App& app, CommandLine& line, Raw& raw) {
  CLI::App* run = app.add_subcommand("run", "fly a scenario, print its verdict, write runs/<scenario>/<seed>/");
  AddFlight(*run, line, raw);
  run->add_option("--out", raw.out, "folder of the run's files (default: runs/<scenario>/<seed>)");
  run->add_flag("--video", line.video, "film the run into video.mp4 of its folder (1280x720, 30 pictures a second)");
  run->add_option("--dataset", raw.format,
                  "also write dataset/ into its folder: what the stack was given, and the truth, in EuRoC's layout or "
                  "TUM's of RGB-D cameras (default: euroc)")
      ->expected(0, 1)
      ->type_name("[euroc|tum]")
      ->check(kFormats);
  run->add_flag("--quiet", line.quiet, "print the last line only");
  run->add_flag("--json", line.json, "print verdict.json instead of the table");
  return run;
}

CLI::App* AddExport(CLI::App& app, CommandLine& line, Raw& raw) {
  CLI::App* verb = app.add_subcommand(
      "export",
      "fly a scenario and write what its sensors said, and the truth, as a dataset; exit codes are those of run");
  AddFlight(*verb, line, raw);
  verb->add_option("--format", raw.format, "euroc (ASL layout: images, IMU) or tum (RGB-D); default: euroc")
      ->check(kFormats);
  verb->add_option("--out", raw.out, "folder of the dataset (default: datasets/<scenario>/<seed>)");
  verb->add_flag("--quiet", line.quiet, "no progress, one line at the end");
  return verb;
}

dataset::Format FormatOf(const std::string& word) {
  return word == "tum" ? dataset::Format::kTum : dataset::Format::kEuroc;
}

/// `check FILES…` and `check sensors SCENARIO`: the files are required by hand, because CLI11 would want them of both.
struct Check {
  CLI::App* files = nullptr;
  CLI::App* sensors = nullptr;
};
Check AddCheck(CLI::App& app, CommandLine& line, Raw& raw) {
  Check check;
  check.files = app.add_subcommand("check", "read YAML files and build what they describe, without flying");
  check.files->add_option("files", line.names, "names of the catalog or YAML files");
  check.files->add_flag("--quiet", line.quiet, "print nothing when all is well");
  check.sensors = check.files->add_subcommand(
      "sensors", "measure a scenario's sensors on a test bench and compare with what is configured");
  check.sensors->add_option("scenario", raw.name, "a name of the catalog ('alula list') or a YAML file")->required();
  AddRender(*check.sensors, line);
  check.sensors->add_flag("--json", line.json, "print JSON instead of the table");
  for (CLI::App* verb : {check.files, check.sensors}) {
    verb->add_option("--set", raw.sets, "path.to.key=value: override any key (may be repeated)")->take_all();
    verb->add_option("--seed", raw.seed, "from which distributions are drawn");
  }
  return check;
}

}  // namespace

std::optional<int> ParseCommandLine(int argc, char** argv, CommandLine& line) {
  CLI::App app("Alula flies navigation stacks in closed loop: a Bullet world, rendered cameras, noisy sensors.",
               "alula");
  app.require_subcommand(1);
  Raw raw;
  CLI::App* run = AddRun(app, line, raw);
  CLI::App* dataset = AddExport(app, line, raw);
  CLI::App* list = app.add_subcommand("list", "name the scenarios, vehicles and worlds of the catalogs");
  list->add_flag("--json", line.json, "as JSON");
  const Check check = AddCheck(app, line, raw);
  CLI::App* bench = app.add_subcommand("bench", "measure, beside a reference in the same run");
  bench->add_option("names", line.names, "benchmarks (default: all)");
  bench->add_option("--json", line.json_file, "write one flat object of figures to this file");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) {
      app.exit(e);
      return 0;
    }
    throw base::InputError(std::string(e.what()) + " ('alula --help' shows how)");
  }
  if (run->parsed() || dataset->parsed()) {
    line.verb = run->parsed() ? CommandLine::Verb::kRun : CommandLine::Verb::kExport;
    line.names = {raw.name};
    if (dataset->parsed() || run->count("--dataset") > 0) line.dataset = FormatOf(raw.format);
  }
  if (list->parsed()) line.verb = CommandLine::Verb::kList;
  if (check.sensors->parsed()) {
    if (!line.names.empty()) throw base::InputError("check sensors: takes one scenario ('alula check sensors --help')");
    line.verb = CommandLine::Verb::kCheckSensors;
    line.names = {raw.name};
  } else if (check.files->parsed()) {
    if (line.names.empty()) throw base::InputError("check: files is required ('alula check --help' shows how)");
    line.verb = CommandLine::Verb::kCheck;
  }
  if (bench->parsed()) line.verb = CommandLine::Verb::kBench;
  const std::size_t seeds =
      run->count("--seed") + dataset->count("--seed") + check.files->count("--seed") + check.sensors->count("--seed");
  if (seeds > 0) line.seed = raw.seed;
  if (!raw.out.empty()) line.out = raw.out;
  for (const std::string& text : raw.sets) line.overrides.push_back(ParseOverride(text));
  return std::nullopt;
}

}  // namespace alula::scenarios::internal
