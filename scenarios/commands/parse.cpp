#include <CLI/CLI.hpp>
#include <cmath>

#include "base/error.h"
#include "scenarios/commands/command_line.h"
#include "scenarios/plugin/plugin_stack.h"

namespace alula::scenarios::commands {
namespace {

struct Raw {
  std::string name;
  std::vector<std::string> sets;
  std::uint64_t seed = 0;
  std::string out;
  std::string format = "euroc";
  std::string stack;
  std::string json, junit;
  double hang_limit_s = 60.0;
  double wall_limit_s = 0.0;
  double memory_limit_mb = 0.0;
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

const CLI::Validator kPositive(
    [](const std::string& text) {
      char* end = nullptr;
      const double value = std::strtod(text.c_str(), &end);
      const bool good = end != text.c_str() && *end == '\0' && std::isfinite(value) && value > 0.0;
      return good ? std::string() : text + " is no number above 0";
    },
    "> 0");

void AddSet(CLI::App& verb, Raw& raw) {
  verb.add_option("--set", raw.sets, "path.to.key=value: override any key (may be repeated)")->take_all();
}

void AddJson(CLI::App& verb, Raw& raw, const std::string& what) {
  verb.add_option("--json", raw.json, "write " + what + " as JSON to this file; -: to the standard output")
      ->type_name("FILE");
}

/// What all verbs that fly understand.
void AddFlight(CLI::App& verb, CommandLine& line, Raw& raw) {
  verb.add_option("--workers", line.workers, "threads inside a run; they change no result")->check(CLI::Range(1, 64));
  AddRender(verb, line);
  verb.add_option("--hang-limit", raw.hang_limit_s, "a run without a step for so many seconds of wall time is a fault")
      ->check(kPositive)
      ->capture_default_str();
  verb.add_option("--wall-limit", raw.wall_limit_s, "a run longer than so many seconds of wall time is a fault")
      ->check(kPositive);
  verb.add_option("--memory-limit", raw.memory_limit_mb, "a run that takes more megabytes is a fault")
      ->check(kPositive);
}

void AddStack(CLI::App& verb, Raw& raw) {
  verb.add_option("--stack", raw.stack, "a shared library (stack/interface/plugin.h) that flies in the stack's place")
      ->type_name("LIBRARY");
}

/// What they understand of the scenario to fly.
CLI::Option* AddScenario(CLI::App& verb, Raw& raw) {
  AddSet(verb, raw);
  AddStack(verb, raw);
  return verb.add_option("scenario", raw.name, "a name of the catalog ('alula list') or a YAML file");
}

void AddSeed(CLI::App& verb, Raw& raw) {
  verb.add_option("--seed", raw.seed, "of all random numbers (default: the scenario's, else 1)");
}

CLI::App* AddRun(CLI::App& app, CommandLine& line, Raw& raw) {
  CLI::App* run = app.add_subcommand("run", "fly a scenario, print its verdict, write runs/<scenario>/<seed>/");
  AddScenario(*run, raw);
  AddSeed(*run, raw);
  AddFlight(*run, line, raw);
  run->add_option("--out", raw.out, "folder of the run's files (default: runs/<scenario>/<seed>)");
  run->add_flag("--video", line.video, "film the run into video.mp4 of its folder (1280x720, 30 pictures a second)");
  run->add_option("--dataset", raw.format,
                  "also write dataset/ into its folder: what the stack was given, and the truth, in EuRoC's layout or "
                  "TUM's of RGB-D cameras (default: euroc)")
      ->expected(0, 1)
      ->type_name("[euroc|tum]")
      ->check(kFormats);
  run->add_flag("--all", line.all, "fly every scenario of the catalog, one after the other");
  run->add_option("--tag", line.tag, "of those, the ones with this tag");
  run->add_flag("--quiet", line.quiet, "print the last line only");
  AddJson(*run, raw, "the verdict");
  run->add_option("--junit", raw.junit, "write the checks as a JUnit report for CI")->type_name("FILE");
  return run;
}

CLI::App* AddExport(CLI::App& app, CommandLine& line, Raw& raw) {
  CLI::App* verb = app.add_subcommand(
      "export",
      "fly a scenario and write what its sensors said, and the truth, as a dataset (exit codes are those of run); or, "
      "with --gallery, draw worlds without flying");
  AddSet(*verb, raw);
  AddStack(*verb, raw);
  verb->add_option("scenario", line.names,
                   "a name of the catalog ('alula list') or a YAML file; with --gallery worlds");
  verb->add_flag("--gallery", line.gallery,
                 "a contact sheet (PNG) of each world named, of all without names: colour, grey, depth, ids by day, "
                 "colour and infrared at night");
  AddSeed(*verb, raw);
  AddFlight(*verb, line, raw);
  verb->add_option("--format", raw.format, "euroc (ASL layout: images, IMU) or tum (RGB-D); default: euroc")
      ->check(kFormats);
  verb->add_option("--out", raw.out,
                   "folder of the dataset (default: datasets/<scenario>/<seed>) or of the gallery (default: gallery)");
  verb->add_flag("--quiet", line.quiet, "no progress, one line at the end");
  return verb;
}

CLI::App* AddSweep(CLI::App& app, CommandLine& line, Raw& raw) {
  CLI::App* verb =
      app.add_subcommand("sweep", "fly a scenario many times, each run in a process of its own, and judge the sample");
  SweepLine& sweep = line.sweep;
  AddScenario(*verb, raw);
  verb->add_option("--runs", sweep.runs,
                   "how many (default: 20; of a grid or list: all of its entries; at most 1000 with --require, 2000 "
                   "with --search)")
      ->check(CLI::Range(std::int64_t{1}, std::int64_t{100'000'000}));
  verb->add_option("--seed", raw.seed, "of the first run; the others follow (default: 1)");
  verb->add_option("--seeds", sweep.seeds, "in place of --runs and --seed: 501-560 or 1-40,77");
  verb->add_option("--order", sweep.order,
                   "how distributions are sampled: random (each seed by itself), lhs (Latin hypercube), sobol")
      ->check(CLI::IsMember({"random", "lhs", "sobol"}));
  verb->add_option("--grid", sweep.grid, "path.to.key=value,value,…: every combination of all grids (may be repeated)")
      ->take_all();
  verb->add_option("--list", sweep.list, "a CSV file: keys in its first line, the values of one run in each other");
  verb->add_option("--jobs", sweep.jobs, "runs at a time (default: as many as there are processors)")
      ->check(CLI::Range(1, 1024));
  verb->add_option("--out", raw.out, "folder of sweep.db and of kept runs (default: sweeps/<scenario>)");
  verb->add_option("--keep", sweep.keep, "which run folders are kept: failed, all or none")
      ->check(CLI::IsMember({"failed", "all", "none"}));
  verb->add_flag("--fresh", sweep.fresh, "begin again: what the folder holds of an earlier sweep goes");
  verb->add_option("--require", sweep.require,
                   "'success >= 0.95 @ 95%' or 'P(METRIC <= LIMIT) >= 0.9 @ 95%': stop as soon as all are decided")
      ->take_all();
  verb->add_option("--search", sweep.search, "failures: look for rare failures and estimate how rare they are")
      ->check(CLI::IsMember({"failures"}));
  verb->add_option("--compare", sweep.compare, "A.db B.db: test two sweeps against each other on equal seeds")
      ->expected(2)
      ->type_name("A.db B.db");
  verb->add_option("--engine", sweep.engine, "local or slurm")->check(CLI::IsMember({"local", "slurm"}));
  verb->add_option("--shards", sweep.shards,
                   "slurm: tasks of the array (default: a task for every 10 runs, at most 1000)")
      ->check(CLI::Range(1, 100'000));
  verb->add_option("--slurm-option", sweep.slurm_options,
                   "--slurm-option=--partition=short: an option of sbatch (may be repeated)")
      ->take_all();
  verb->add_flag("--watch", sweep.watch, "slurm: stay until all runs are done; submit again what was lost");
  verb->add_flag("--dry-run", sweep.dry_run, "slurm: print the batch script, submit nothing");
  verb->add_option("--worker", sweep.worker, "run one shard of this sweep folder")->group("");
  verb->add_option("--shard", sweep.shard, "its number")->group("");
  AddFlight(*verb, line, raw);
  verb->add_flag("--quiet", line.quiet, "print the last line only");
  AddJson(*verb, raw, "the result");
  verb->add_option("--junit", raw.junit, "write the runs as a JUnit report for CI")->type_name("FILE");
  return verb;
}

CLI::App* AddReplay(CLI::App& app, CommandLine& line, Raw& raw) {
  CLI::App* verb = app.add_subcommand(
      "replay", "fly a run again and check that it is the same, or name the first difference of two runs");
  verb->add_option("runs", line.names, "a run folder, or SWEEP.db#SEED; with --diff two of them")->required();
  verb->add_flag("--diff", line.diff, "name the first difference of two runs");
  verb->add_flag("--video", line.video, "film it");
  verb->add_option("--out", raw.out, "folder of the new run's files (default: replay/<scenario>/<seed>)");
  AddFlight(*verb, line, raw);
  verb->add_flag("--quiet", line.quiet, "print the last line only");
  AddJson(*verb, raw, "the result");
  return verb;
}

/// `slam SOURCES…` and `slam train-vocabulary`: the sources are required by hand, because CLI11 would want them of
/// both.
struct SlamVerb {
  CLI::App* estimate = nullptr;
  CLI::App* train = nullptr;
};
SlamVerb AddSlam(CLI::App& app, CommandLine& line, Raw& raw) {
  SlamVerb slam;
  CLI::App* verb = slam.estimate = app.add_subcommand(
      "slam", "run the estimator on recorded data, or along a flight as it is rendered, and measure its trajectory");
  verb->add_option("sources", line.names,
                   "folders of recordings (EuRoC's, KITTI's or TUM's layout), scenarios of the catalog or files");
  verb->add_option(
          "--variant", line.variants,
          "NAME or NAME:KEY=VALUE,KEY=VALUE: an estimator with these keys of `stack` changed; all variants see "
          "the same images (may be repeated)")
      ->take_all();
  AddSet(*verb, raw);
  verb->add_option("--seeds", line.sweep.seeds, "of scenarios, one flight each: 1-3 or 1,5 (default: the scenario's)");
  AddFlight(*verb, line, raw);
  verb->add_flag("--save-map", line.save_map, "write the map of each estimator beside its trajectories: map.alula");
  verb->add_option("--load-map", line.load_map, "a map from before, in which every estimator finds itself again")
      ->type_name("FILE");
  verb->add_option("--camera", line.camera_yaml, "calibration of a recording in TUM's layout, in place of its own")
      ->type_name("FILE");
  verb->add_option("--out", raw.out, "folder of the trajectories (default: runs/slam/<name>)");
  verb->add_flag("--quiet", line.quiet, "no progress");
  AddJson(*verb, raw, "all figures");
  slam.train = verb->add_subcommand("train-vocabulary",
                                    "draw views of all worlds of the catalog and train the tree of visual words");
  slam.train->add_option("--out", raw.out, "the file to write")->type_name("FILE")->required();
  AddRender(*slam.train, line);
  slam.train->add_flag("--quiet", line.quiet, "no progress");
  return slam;
}

dataset::Format FormatOf(const std::string& word) {
  return word == "tum" ? dataset::Format::kTum : dataset::Format::kEuroc;
}

/// `check FILES…` and `check sensors SCENARIO`: the files are required by hand, because CLI11 would want them of both.
struct Check {
  CLI::App* files = nullptr;
  CLI::App* sensors = nullptr;
  CLI::App* textures = nullptr;
  CLI::App* landing = nullptr;
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
  AddJson(*check.sensors, raw, "the report");
  check.textures = check.files->add_subcommand(
      "textures", "count the corners and lines that worlds offer a tracker, beside pictures of real cameras");
  check.textures->add_option("worlds", line.names, "names of the catalog or YAML files (default: all worlds)");
  check.textures->add_option("--beside", line.beside, "a folder of PNG files to measure likewise (may be repeated)")
      ->type_name("DIR");
  check.textures->add_option("--pictures", line.pictures, "views of each world (default: 40)")
      ->check(CLI::Range(1, 10'000));
  AddRender(*check.textures, line);
  AddJson(*check.textures, raw, "the table");
  check.landing = check.files->add_subcommand(
      "landing",
      "find where a world is safe to land on from its geometry, and check it by dropping the q250 there; 1 "
      "where it stands on less than 99 %");
  check.landing->add_option("world", raw.name, "a name of the catalog or a YAML file")->required();
  check.landing->add_option("--drops", line.drops, "on safe cells; half as many on others (default: 200)")
      ->check(CLI::Range(1, 100'000));
  check.landing->add_option("--out", raw.out, "folder for the mask: grid.pgm and grid.yaml, as ROS maps");
  AddJson(*check.landing, raw, "the report");
  for (CLI::App* verb : {check.files, check.sensors, check.textures, check.landing}) {
    AddSet(*verb, raw);
    verb->add_option("--seed", raw.seed, "from which distributions are drawn");
  }
  return check;
}

Limits LimitsOf(const Raw& raw) {
  Limits limits;
  limits.stall = base::Seconds(raw.hang_limit_s);
  if (raw.wall_limit_s > 0.0) limits.wall = base::Seconds(raw.wall_limit_s);
  if (raw.memory_limit_mb > 0.0) limits.memory = static_cast<std::uint64_t>(raw.memory_limit_mb * 1e6);
  return limits;
}

/// What was read as text becomes what it means.
void Understand(const Raw& raw, CommandLine& line) {
  if (!raw.name.empty()) line.names = {raw.name};
  if (!raw.out.empty()) line.out = raw.out;
  line.json = raw.json;
  line.junit = raw.junit;
  line.limits = LimitsOf(raw);
  if (!raw.stack.empty()) line.overrides.push_back(StackOverride(raw.stack));  // before the keys set in it
  for (const std::string& text : raw.sets) line.overrides.push_back(ParseOverride(text));
}

void CheckRun(const CommandLine& line) {
  if (line.all == !line.names.empty()) {
    throw base::InputError(line.all ? "run: --all flies the catalog; leave out the scenario's name"
                                    : "run: scenario is required ('alula run --help' shows how)");
  }
  if (!line.all && !line.tag.empty()) throw base::InputError("run: --tag goes with --all");
}

void CheckExport(const CommandLine& line) {
  if (!line.gallery && line.names.size() != 1) {
    throw base::InputError("export: takes one scenario ('alula export --help' shows how)");
  }
}

void CheckSweep(const CommandLine& line) {
  const SweepLine& sweep = line.sweep;
  if (!sweep.search.empty() && sweep.engine != "local") {
    throw base::InputError("sweep: --search looks at each level before it flies the next; leave out --engine");
  }
  if (line.names.empty() && sweep.compare.empty() && sweep.worker.empty()) {
    throw base::InputError("sweep: scenario is required ('alula sweep --help' shows how)");
  }
  if (!sweep.seeds.empty() && (sweep.runs || line.seed)) {
    throw base::InputError("sweep: --seeds names all runs; leave out --runs and --seed");
  }
  if (sweep.engine == "local" && (sweep.watch || sweep.dry_run || sweep.shards > 0 || !sweep.slurm_options.empty())) {
    throw base::InputError("sweep: --watch, --dry-run, --shards and --slurm-option go with --engine slurm");
  }
}

}  // namespace

std::optional<int> ParseCommandLine(int argc, char** argv, CommandLine& line) {
  CLI::App app("Alula flies navigation stacks in closed loop: a Bullet world, rendered cameras, noisy sensors.",
               "alula");
  app.require_subcommand(1);
  Raw raw;
  CLI::App* run = AddRun(app, line, raw);
  CLI::App* dataset = AddExport(app, line, raw);
  CLI::App* sweep = AddSweep(app, line, raw);
  CLI::App* replay = AddReplay(app, line, raw);
  const SlamVerb slam = AddSlam(app, line, raw);
  CLI::App* list = app.add_subcommand("list", "name the scenarios, vehicles and worlds of the catalogs");
  list->add_option("kind", line.kind, "scenarios, vehicles or worlds alone")
      ->check(CLI::IsMember({"scenarios", "vehicles", "worlds"}));
  AddJson(*list, raw, "the list");
  const Check check = AddCheck(app, line, raw);
  CLI::App* bench = app.add_subcommand("bench", "measure, beside a reference in the same run");
  bench->add_option("names", line.names, "benchmarks (default: all)");
  AddJson(*bench, raw, "one flat object of figures");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) {
      app.exit(e);
      return 0;
    }
    throw base::InputError(std::string(e.what()) + " ('alula --help' shows how)");
  }
  if (check.sensors->parsed() && !line.names.empty()) {
    throw base::InputError("check sensors: takes one scenario ('alula check sensors --help')");
  }
  if (check.landing->parsed() && !line.names.empty()) {
    throw base::InputError("check landing: takes one world ('alula check landing --help')");
  }
  std::size_t seeds = 0;
  for (const CLI::App* verb : {check.files, check.sensors, check.textures, check.landing})
    seeds += verb->count("--seed");
  for (const CLI::App* verb : {run, dataset, sweep}) seeds += verb->count("--seed");
  if (seeds > 0) line.seed = raw.seed;
  Understand(raw, line);
  if (dataset->parsed()) CheckExport(line);
  if (run->parsed() || dataset->parsed()) {
    line.verb = run->parsed() ? CommandLine::Verb::kRun : CommandLine::Verb::kExport;
    if (run->parsed()) CheckRun(line);
    if (dataset->parsed() || run->count("--dataset") > 0) line.dataset = FormatOf(raw.format);
    if (line.gallery) line.verb = CommandLine::Verb::kGallery;
  }
  if (sweep->parsed()) {
    line.verb = CommandLine::Verb::kSweep;
    CheckSweep(line);
  }
  if (replay->parsed()) line.verb = CommandLine::Verb::kReplay;
  if (slam.train->parsed()) {
    if (!line.names.empty()) throw base::InputError("slam train-vocabulary: takes no sources");
    line.verb = CommandLine::Verb::kTrainVocabulary;
  } else if (slam.estimate->parsed()) {
    if (line.names.empty()) throw base::InputError("slam: sources are required ('alula slam --help' shows how)");
    line.verb = CommandLine::Verb::kSlam;
  }
  if (list->parsed()) line.verb = CommandLine::Verb::kList;
  if (check.sensors->parsed()) {
    line.verb = CommandLine::Verb::kCheckSensors;
  } else if (check.textures->parsed()) {
    line.verb = CommandLine::Verb::kCheckTextures;
  } else if (check.landing->parsed()) {
    line.verb = CommandLine::Verb::kCheckLanding;
  } else if (check.files->parsed()) {
    if (line.names.empty()) throw base::InputError("check: files is required ('alula check --help' shows how)");
    line.verb = CommandLine::Verb::kCheck;
  }
  if (bench->parsed()) line.verb = CommandLine::Verb::kBench;
  return std::nullopt;
}

}  // namespace alula::scenarios::commands
