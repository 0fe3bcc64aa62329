#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/config.h"
#include "scenarios/dataset/dataset_writer.h"
#include "scenarios/supervisor.h"

namespace alula::scenarios::commands {

/// What only `sweep` understands.
struct SweepLine {
  std::optional<std::int64_t> runs;
  std::string seeds;
  std::string order = "random";
  std::vector<std::string> grid;
  std::string list;
  int jobs = 0;  // 0: as many as there are processors
  std::string keep = "failed";
  std::vector<std::string> require;
  std::vector<std::string> compare;
  std::string search;
  bool fresh = false;
  std::string engine = "local";
  int shards = 0;  // 0: chosen from the number of runs
  bool watch = false;
  bool dry_run = false;
  std::vector<std::string> slurm_options;
  std::string worker;  // the folder of the sweep whose shard this process is to run
  int shard = 0;
};

/// The command line, understood.
struct CommandLine {
  enum class Verb {
    kRun,
    kExport,
    kSweep,
    kReplay,
    kSlam,
    kTrainVocabulary,
    kList,
    kCheck,
    kCheckSensors,
    kCheckTextures,
    kCheckLanding,
    kGallery,
    kBench
  };
  Verb verb = Verb::kList;
  std::vector<std::string> names;  // of scenarios, files, runs or benchmarks
  std::optional<std::uint64_t> seed;
  std::vector<base::Override> overrides;
  std::optional<std::filesystem::path> out;
  int workers = 1;
  std::string render = "auto";
  bool video = false;
  std::optional<dataset::Format> dataset;  // of run and export
  Limits limits;
  std::string kind;                 // list: of these alone
  std::vector<std::string> beside;  // check textures: folders of real pictures
  int pictures = 40;                // check textures: views a world
  bool gallery = false;             // export: worlds in place of a flight
  bool all = false;                 // run: every scenario of the catalog
  std::string tag;                  // of those
  int drops = 200;                  // check landing: on safe cells
  bool diff = false;
  std::vector<std::string> variants;  // slam: NAME:KEY=VALUE,…
  std::filesystem::path load_map;     // slam: a map from before; empty: none
  bool save_map = false;              // slam
  std::filesystem::path camera_yaml;  // slam: calibration of a TUM RGB-D recording; empty: its own
  bool quiet = false;
  std::filesystem::path json;   // file of figures or verdicts; "-": standard output; empty: none
  std::filesystem::path junit;  // likewise
  SweepLine sweep;

  /// Whether tables and progress are to be printed.
  bool talks() const { return !quiet && json != "-"; }
};

/// Understands argv. Gives 0 where nothing is left to do (--help was printed). Throws base::InputError.
std::optional<int> ParseCommandLine(int argc, char** argv, CommandLine& out);

}  // namespace alula::scenarios::commands
