#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/scenarios/temporary_folder.h"

namespace alula::scenarios::slurm::testing {

/// Why no cluster can be started here (not root, no Slurm), in one line; empty where one can.
std::string WhyNoCluster();

/// A Slurm cluster on this machine for one test, see cluster.sh; SLURM_CONF leads to it, gone afterwards. Throws
/// std::runtime_error with what Slurm says where a step fails.
class Cluster {
 public:
  Cluster();
  ~Cluster();
  Cluster(const Cluster&) = delete;
  Cluster& operator=(const Cluster&) = delete;

  void KillNode(const std::string& node) { Do({"kill-node", node}); }      ///< with all that runs on it
  void KillDaemon(const std::string& node) { Do({"kill-daemon", node}); }  ///< its jobs live on
  void StartNode(const std::string& node) { Do({"start-node", node}); }
  void KillController() { Do({"kill-controller"}); }
  void StartController() { Do({"start-controller"}); }
  /// Requeued tasks start at once, not after the two minutes that Slurm makes them wait.
  void Hurry() { Do({"hurry"}); }

 private:
  void Do(const std::vector<std::string>& verb);

  scenarios::testing::TemporaryFolder folder_;
};

}  // namespace alula::scenarios::slurm::testing
