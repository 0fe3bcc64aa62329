#include "scenarios/campaign/statistics/orders.h"

#include <boost/random/sobol.hpp>
#include <numeric>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/random.h"

namespace alula::scenarios::statistics {

namespace {

using Points = std::vector<std::vector<double>>;

/// In (0, 1), both excluded, because quantile functions are infinite there: 52 bits and a half are exact in a double.
double OpenUnit(std::uint64_t bits) { return (static_cast<double>(bits >> 12) + 0.5) * 0x1p-52; }

/// In (0, 1) with 30 bits, so that stratum + share is exact up to 2^22 runs and no point rounds into the next stratum.
double OpenUnitCoarse(std::uint64_t bits) { return (static_cast<double>(bits >> 34) + 0.5) * 0x1p-30; }

std::vector<std::int64_t> Permutation(std::int64_t size, base::RandomStream& random) {
  std::vector<std::int64_t> order(static_cast<std::size_t>(size));
  std::iota(order.begin(), order.end(), std::int64_t{0});
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.Index(i)]);
  return order;
}

Points EmptyPoints(std::int64_t runs, std::size_t dimensions) {
  return Points(static_cast<std::size_t>(runs), std::vector<double>(dimensions));
}

}  // namespace

Points LatinHypercube(std::int64_t runs, std::size_t dimensions, std::uint64_t seed) {
  Points points = EmptyPoints(runs, dimensions);
  for (std::size_t k = 0; k < dimensions; ++k) {
    base::RandomStream random(seed, "order/latin_hypercube/" + std::to_string(k));
    const std::vector<std::int64_t> stratum = Permutation(runs, random);
    for (std::size_t i = 0; i < points.size(); ++i) {
      points[i][k] = (static_cast<double>(stratum[i]) + OpenUnitCoarse(random.Bits())) / static_cast<double>(runs);
    }
  }
  return points;
}

Points SobolPoints(std::int64_t first, std::int64_t runs, std::size_t dimensions, std::uint64_t seed) {
  if (dimensions > kMaxSobolDimensions) {
    throw base::InputError("a Sobol order has at most " + std::to_string(kMaxSobolDimensions) + " dimensions, not " +
                           std::to_string(dimensions));
  }
  Points points = EmptyPoints(runs, dimensions);
  if (dimensions == 0) return points;
  std::vector<std::uint64_t> shift(dimensions);
  for (std::size_t k = 0; k < dimensions; ++k) {
    shift[k] = base::RandomStream(seed, "order/sobol/" + std::to_string(k)).Bits();
  }

  boost::random::sobol sequence(dimensions);  // leaves out point 0, which is the origin
  if (first > 0) sequence.seed(static_cast<std::uint64_t>(first - 1));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool origin = first == 0 && i == 0;
    for (std::size_t k = 0; k < dimensions; ++k) points[i][k] = OpenUnit((origin ? 0 : sequence()) ^ shift[k]);
  }
  return points;
}

}  // namespace alula::scenarios::statistics
