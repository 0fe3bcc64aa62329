#include "scenarios/campaign/statistics/orders.h"

#include <boost/random/sobol.hpp>
#include <numeric>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/random.h"

namespace alula::scenarios::statistics {

std::vector<std::vector<double>> LatinHypercube(std::int64_t runs, std::size_t dimensions, std::uint64_t seed) {
  const auto n = static_cast<std::size_t>(runs);
  std::vector<std::vector<double>> points(n, std::vector<double>(dimensions));
  for (std::size_t d = 0; d < dimensions; ++d) {
    base::RandomStream stream(seed, "latin_hypercube/" + std::to_string(d));
    std::vector<std::size_t> slices(n);
    std::iota(slices.begin(), slices.end(), std::size_t{0});
    for (std::size_t i = n; i > 1; --i) std::swap(slices[i - 1], slices[stream.Index(i)]);  // Fisher and Yates
    for (std::size_t i = 0; i < n; ++i) {
      double inside = stream.Uniform();
      while (inside == 0.0) inside = stream.Uniform();
      points[i][d] = (static_cast<double>(slices[i]) + inside) / static_cast<double>(n);
    }
  }
  return points;
}

std::vector<std::vector<double>> SobolPoints(std::int64_t first, std::int64_t runs, std::size_t dimensions,
                                             std::uint64_t seed) {
  if (dimensions > kMostSobolDimensions) {
    throw base::InputError("Sobol's sequence has at most " + std::to_string(kMostSobolDimensions) +
                           " dimensions, not " + std::to_string(dimensions));
  }
  constexpr int kDigits = 64;
  std::vector<std::vector<double>> points(static_cast<std::size_t>(runs), std::vector<double>(dimensions));
  if (dimensions == 0) return points;
  boost::random::sobol_engine<std::uint64_t, kDigits> engine(dimensions);
  // The engine begins with the second point; the first, all zeros, belongs to the sequence: 2^k points are balanced.
  if (first > 0) engine.discard(static_cast<std::uint64_t>(first - 1) * dimensions);
  std::vector<std::uint64_t> shift(dimensions);
  base::RandomStream stream(seed, "sobol");
  for (std::uint64_t& digits : shift) digits = stream.Bits();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool origin = first == 0 && i == 0;
    for (std::size_t d = 0; d < dimensions; ++d) {
      const std::uint64_t digits = ((origin ? 0 : engine()) ^ shift[d]) >> 11U;  // 53 of them, mid-cell
      points[i][d] = (static_cast<double>(digits) + 0.5) * 0x1p-53;
    }
  }
  return points;
}

}  // namespace alula::scenarios::statistics
