#include "tests/scenarios/campaign/slurm/cluster.h"

#include <unistd.h>

#include <cstdlib>
#include <iostream>
#include <stdexcept>

#include "scenarios/campaign/slurm/run_command.h"

namespace alula::scenarios::slurm::testing {

namespace {

CommandOutcome Script(const std::vector<std::string>& arguments) {
  std::vector<std::string> argv = {ALULA_SOURCE_DIR "/tests/scenarios/campaign/slurm/cluster.sh"};
  argv.insert(argv.end(), arguments.begin(), arguments.end());
  return RunCommand(argv);
}

}  // namespace

std::string WhyNoCluster() {
  const CommandOutcome outcome = Script({"check"});
  return outcome.exit_code == 0 ? "" : outcome.out + outcome.err;
}

Cluster::Cluster() : folder_("slurm") {
  try {
    Do({"start", std::to_string(::getpid())});
  } catch (...) {
    Script({"stop", folder_.path().string()});
    throw;
  }
  ::setenv("SLURM_CONF", (folder_.path() / "slurm.conf").c_str(), 1);
}

Cluster::~Cluster() {
  ::unsetenv("SLURM_CONF");
  const CommandOutcome outcome = Script({"stop", folder_.path().string()});
  if (outcome.exit_code != 0) std::cerr << "the test's cluster is left behind: " << outcome.err;
}

void Cluster::Do(const std::vector<std::string>& verb) {
  std::vector<std::string> arguments = {verb.front(), folder_.path().string()};
  arguments.insert(arguments.end(), verb.begin() + 1, verb.end());
  const CommandOutcome outcome = Script(arguments);
  if (outcome.exit_code != 0) throw std::runtime_error(verb.front() + ": " + outcome.err);
}

}  // namespace alula::scenarios::slurm::testing
