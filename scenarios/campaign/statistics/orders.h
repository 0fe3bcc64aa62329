#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace alula::scenarios::statistics {

/// Points of the open unit cube, one a run, in which every dimension has one point in each of `runs` equal slices
/// (McKay, Beckman and Conover 1979).
std::vector<std::vector<double>> LatinHypercube(std::int64_t runs, std::size_t dimensions, std::uint64_t seed);

/// Sobol's sequence (1967; direction numbers of Joe and Kuo 2008) from point `first` on, shifted digit by digit by the
/// seed, so that no coordinate is 0 or 1. The first points do not change when more are asked for.
/// Throws base::InputError for more than kMostSobolDimensions.
std::vector<std::vector<double>> SobolPoints(std::int64_t first, std::int64_t runs, std::size_t dimensions,
                                             std::uint64_t seed);
constexpr std::size_t kMostSobolDimensions = 3667;

}  // namespace alula::scenarios::statistics
