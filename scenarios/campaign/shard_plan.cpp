#include "scenarios/campaign/internal/shard_plan.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/error.h"

namespace alula::scenarios::campaign::internal {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;

Json ReadPlan(const fs::path& folder) {
  std::ostringstream text;
  text << std::ifstream(folder / "plan.json").rdbuf();
  const Json json = Json::parse(text.str(), nullptr, false);
  return json.is_object() ? json : Json();
}

ExecutorOptions ExecutorOf(const Json& json) {
  ExecutorOptions e;
  e.jobs = json.at("jobs");
  e.workers = json.at("workers");
  e.render = json.at("render");
  e.keep = static_cast<Keep>(json.at("keep").get<int>());
  e.limits.stall = base::Seconds(json.at("hang_limit_s"));
  if (json.contains("wall_limit_s")) e.limits.wall = base::Seconds(json.at("wall_limit_s"));
  if (json.contains("memory_limit")) e.limits.memory = json.at("memory_limit").get<std::uint64_t>();
  return e;
}

}  // namespace

fs::path ShardFile(const fs::path& folder, int shard) { return folder / "shards" / (std::to_string(shard) + ".db"); }

std::string WorkersPlan(const SweepRequest& request, int shards) {
  Json json;
  json["plan"] = Json::parse(ToJson(request.plan));
  json["shards"] = shards;
  const ExecutorOptions& e = request.executor;
  json["executor"] = {{"jobs", e.jobs},
                      {"workers", e.workers},
                      {"render", e.render},
                      {"keep", static_cast<int>(e.keep)},
                      {"hang_limit_s", e.limits.stall.Seconds()}};
  if (e.limits.wall) json["executor"]["wall_limit_s"] = e.limits.wall->Seconds();
  if (e.limits.memory) json["executor"]["memory_limit"] = *e.limits.memory;
  return json.dump(2) + "\n";
}

WorkersOrders ReadWorkersPlan(const fs::path& folder) {
  WorkersOrders orders;
  try {
    const Json json = ReadPlan(folder);
    orders.shards = json.at("shards");
    orders.request.plan = PlanFromJson(json.at("plan").dump());
    orders.request.executor = ExecutorOf(json.at("executor"));
  } catch (const Json::exception&) {
    throw base::InputError(folder.string() + ": holds no plan.json of a sweep");
  }
  orders.request.out = folder;
  return orders;
}

int ShardsOfPlan(const fs::path& folder) {
  const Json json = ReadPlan(folder);
  return json.is_object() ? json.value("shards", 0) : 0;
}

}  // namespace alula::scenarios::campaign::internal
