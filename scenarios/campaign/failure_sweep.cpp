#include "scenarios/campaign/failure_sweep.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "scenarios/campaign/internal/sweep_flight.h"
#include "scenarios/campaign/same_sweep.h"
#include "scenarios/campaign/sweep_folder.h"

namespace alula::scenarios::campaign {
namespace {

/// A point of standard normal space as shares of each distribution.
std::vector<double> QuantilesOf(const std::vector<double>& point) {
  std::vector<double> shares;
  for (const double z : point) shares.push_back(0.5 * std::erfc(-z / std::sqrt(2.0)));
  return shares;
}

/// The parameters in the middle of a region of failures, and a standard deviation to both sides.
FailureSweepResult::Region DescribeRegion(const search::FailureRegion& region, const CaseMaker& cases) {
  const auto at = [&](double side) {
    std::vector<double> point = region.mean;
    for (std::size_t i = 0; i < point.size(); ++i) point[i] += side * region.spread[i];
    const std::vector<double> shares = QuantilesOf(point);
    return cases.Make(0, &shares).parameters;
  };
  const auto low = at(-1.0), middle = at(0.0), high = at(1.0);
  FailureSweepResult::Region described;
  described.share = region.share;
  for (const std::string& path : cases.distributions()) {
    if (!middle.contains(path) || !low.contains(path) || !high.contains(path)) continue;
    described.parameters.push_back({path, low.at(path).value, middle.at(path).value, high.at(path).value});
  }
  return described;
}

}  // namespace

FailureSweepResult SearchFailures(const SweepRequest& request, search::FailureSearchConfig config) {
  const CaseMaker cases(request.plan);
  if (cases.distributions().empty()) {
    throw base::InputError("--search failures: nothing in " + cases.name() +
                           " is a distribution; give one, as --set 'vehicle.mass={normal: [0.75 kg, 0.02 kg]}'");
  }
  const SweepFolder folder(request.out, request.fresh);
  Database database(folder.path() / "sweep.db", Database::Mode::kWrite);
  CheckSameProgram(database, cases.name());
  internal::SweepFlight sweep(request, cases, database, {});
  config.max_runs = static_cast<std::int64_t>(request.plan.seeds.size());
  search::FailureSearch search(config, cases.distributions().size(), request.plan.seeds.front());
  FailureSweepResult result;
  for (std::size_t first = 0; !search.done() && !result.sweep.interrupted;) {
    std::vector<std::vector<double>> points;
    for (const std::vector<double>& point : search.Ask()) points.push_back(QuantilesOf(point));
    const std::size_t end = first + points.size();
    if (sweep.Fly(folder.path() / ".work", first, end, &points)) {
      result.sweep.interrupted = true;
      break;
    }
    std::vector<double> margins;
    for (std::size_t i = first; i < end; ++i) margins.push_back(MarginOf(sweep.row(i)->verdict));
    search.Tell(margins);
    first = end;
  }
  if (search.done()) result.estimate = search.estimate();
  for (const search::FailureRegion& region : result.estimate.regions) {
    result.regions.push_back(DescribeRegion(region, cases));
  }
  const bool interrupted = result.sweep.interrupted;
  result.sweep = sweep.Result();
  result.sweep.interrupted = interrupted;
  return result;
}

double MarginOf(const Verdict& verdict) {
  constexpr double kBarely = 1e-9;
  if (verdict.outcome == Outcome::kFault) return -std::numeric_limits<double>::infinity();
  double margin = std::numeric_limits<double>::infinity();
  for (const Check& check : verdict.checks) {
    const bool counts = check.unit == "1" && check.limit == 0.0;  // contacts, faults: they say yes or no
    double room = check.relation.front() == '<' ? check.limit - check.measured : check.measured - check.limit;
    room /= check.limit == 0.0 ? 1.0 : std::abs(check.limit);
    if (!std::isfinite(check.measured)) room = -1.0;
    margin = std::min(margin, check.passed ? (counts ? margin : std::max(kBarely, room)) : std::min(0.0, room));
  }
  return margin;
}

}  // namespace alula::scenarios::campaign
