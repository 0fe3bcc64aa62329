#include <opencv2/core/utility.hpp>

#include "scenarios/commands/flight.h"
#include "scenarios/commands/verbs.h"
#include "scenarios/environment.h"
#include "scenarios/exit_codes.h"

namespace alula::scenarios {
namespace {

int Main(int argc, char** argv) {
  using commands::CommandLine;
  CommandLine line;
  if (const std::optional<int> done = commands::ParseCommandLine(argc, argv, line)) return *done;
  switch (line.verb) {
    case CommandLine::Verb::kRun:
      return commands::Run(line);
    case CommandLine::Verb::kExport:
      return commands::Export(line);
    case CommandLine::Verb::kSweep:
      return commands::Sweep(line);
    case CommandLine::Verb::kReplay:
      return commands::Replay(line);
    case CommandLine::Verb::kSlam:
      return commands::Slam(line);
    case CommandLine::Verb::kTrainVocabulary:
      return commands::TrainVocabulary(line);
    case CommandLine::Verb::kList:
      return commands::List(line);
    case CommandLine::Verb::kCheck:
      return commands::CheckFiles(line);
    case CommandLine::Verb::kCheckSensors:
      return commands::CheckSensors(line);
    case CommandLine::Verb::kCheckTextures:
      return commands::CheckTextures(line);
    case CommandLine::Verb::kCheckLanding:
      return commands::CheckLanding(line);
    case CommandLine::Verb::kGallery:
      return commands::Gallery(line);
    case CommandLine::Verb::kBench:
      return commands::Bench(line);
  }
  return kExitFault;
}

}  // namespace
}  // namespace alula::scenarios

int main(int argc, char** argv) {
  using namespace alula;
  scenarios::FixEnvironment(argv);
  cv::setNumThreads(1);
  return scenarios::commands::Guarded([&] { return scenarios::Main(argc, argv); });
}
