#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "scenarios/campaign/statistics/paired_tests.h"

namespace alula::scenarios::campaign {

/// Two sweeps tested against each other on the seeds that both have: the same seed is the same world, noise and
/// parameters, so that differences are told far sooner than from two samples.
struct Comparison {
  std::string a, b;  // the files
  std::size_t pairs = 0;
  std::size_t only_a = 0, only_b = 0;       // runs without a partner
  std::int64_t passes_a = 0, passes_b = 0;  // of the pairs
  statistics::McNemarTest success;
  std::vector<std::uint64_t> only_a_passes, only_b_passes;  // seeds
  struct Metric {
    std::string name;
    statistics::WilcoxonTest test;  // of B − A
    double median_a = 0.0, median_b = 0.0;
  };
  std::vector<Metric> metrics;
  std::size_t equal_digests = 0;
};

/// Throws base::InputError where a file is no sweep or the two have no seed in common.
Comparison CompareSweeps(const std::filesystem::path& a, const std::filesystem::path& b);

std::string ToTable(const Comparison& comparison);
std::string ToJson(const Comparison& comparison);

}  // namespace alula::scenarios::campaign
