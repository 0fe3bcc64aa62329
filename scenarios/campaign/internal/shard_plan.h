#pragma once

#include <filesystem>
#include <string>

#include "scenarios/campaign/sweep.h"

namespace alula::scenarios::campaign::internal {

// plan.json of a sweep's folder: what the processes that fly its shards must know.

std::string WorkersPlan(const SweepRequest& request, int shards);

struct WorkersOrders {
  SweepRequest request;
  int shards = 0;
};
/// Throws base::InputError.
WorkersOrders ReadWorkersPlan(const std::filesystem::path& folder);

/// How many shards the folder's plan has; 0 where there is none.
int ShardsOfPlan(const std::filesystem::path& folder);

/// The database of a shard.
std::filesystem::path ShardFile(const std::filesystem::path& folder, int shard);

}  // namespace alula::scenarios::campaign::internal
