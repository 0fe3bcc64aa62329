#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace alula::scenarios::statistics {

/// Most dimensions of SobolPoints: the direction numbers of Joe & Kuo 2008 that Boost holds.
constexpr std::size_t kMaxSobolDimensions = 3667;

/// [runs][dimensions] points of the open unit cube: in every dimension each of the `runs` equal strata holds exactly
/// one point (McKay, Beckman & Conover 1979). All points depend on `runs`: a sweep that grows is another design.
std::vector<std::vector<double>> LatinHypercube(std::int64_t runs, std::size_t dimensions, std::uint64_t seed);

/// [runs][dimensions] points first … first + runs - 1 of the Sobol sequence, in the open unit cube; point i does not
/// depend on how many are asked for. Best balanced where first is 0 and runs a power of two. Each dimension is
/// shifted digitally (exclusive or with random bits of `seed`), which keeps the balance and makes the means unbiased.
/// InputError for more than kMaxSobolDimensions.
std::vector<std::vector<double>> SobolPoints(std::int64_t first, std::int64_t runs, std::size_t dimensions,
                                             std::uint64_t seed);

}  // namespace alula::scenarios::statistics
