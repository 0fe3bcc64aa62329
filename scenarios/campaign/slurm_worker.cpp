#include "base/error.h"
#include "scenarios/campaign/internal/shard_plan.h"
#include "scenarios/campaign/slurm/shard_claim.h"
#include "scenarios/campaign/slurm_sweep.h"

namespace alula::scenarios::campaign {
namespace {

constexpr double kClaimPatience = 120.0;  // s that a task waits for the one before it to let go of the shard

}  // namespace

SweepResult RunWorker(const std::filesystem::path& folder, int shard) {
  const internal::WorkersOrders orders = internal::ReadWorkersPlan(folder);
  const std::filesystem::path file = internal::ShardFile(folder, shard);
  const std::filesystem::path claimed = file.string() + ".claim";
  const std::optional<slurm::ShardClaim> claim =
      slurm::ShardClaim::Wait(claimed, slurm::ThisProcess(), kClaimPatience, nullptr);
  if (!claim) {
    const std::optional<slurm::ClaimHolder> holder = slurm::ReadHolder(claimed);
    throw base::FaultError(
        "claim", "shard " + std::to_string(shard) + " is held by " + (holder ? holder->Text() : "another process"));
  }
  return RunShard(orders.request, {shard, orders.shards, [&claim] { return claim->StillHeld(); }}, file);
}

}  // namespace alula::scenarios::campaign
