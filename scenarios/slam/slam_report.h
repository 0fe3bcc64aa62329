#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "scenarios/slam/estimator_run.h"

namespace alula::scenarios::slam {

/// All estimators of one flight or recording, beside what was true.
struct SlamReport {
  std::string name;
  std::uint64_t seed = 1;
  std::vector<EstimatorResult> results;
  std::vector<base::StampedPose> truth;  // empty: only times and completeness are told
};

SlamReport Judge(const std::string& name, std::uint64_t seed, std::vector<EstimatorResult> results,
                 std::vector<base::StampedPose> truth);

/// truth.tum, and of each estimator estimate.tum and estimate_final.tum in a folder of its name, and map.alula
/// where it keeps its map; slam.json.
void WriteFiles(const SlamReport& report, const std::filesystem::path& folder);

nlohmann::ordered_json ToJson(const SlamReport& report);
std::string ToTable(const nlohmann::ordered_json& report);

}  // namespace alula::scenarios::slam
