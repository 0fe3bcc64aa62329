#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/config.h"

namespace alula::scenarios::campaign {

enum class Order { kRandom, kLatinHypercube, kSobol };

/// A key that takes several values in turn.
struct GridAxis {
  std::string path;
  std::vector<std::string> values;  // as YAML reads them
};

/// What a sweep is asked to fly. A copy of it lies in the sweep's folder as plan.json.
struct SweepPlan {
  std::string scenario;  // absolute path of its file
  std::vector<base::Override> overrides;
  std::vector<std::uint64_t> seeds;  // one a run, in their order
  Order order = Order::kRandom;
  std::vector<GridAxis> grid;                       // run i flies combination i mod (their number)
  std::vector<std::string> list_keys;               // run i flies row i mod (their number)
  std::vector<std::vector<std::string>> list_rows;  // each as long as list_keys

  /// Combinations of the grid, or rows of the list; 1 where there is neither.
  std::size_t Variants() const;
};

/// One run of a sweep, ready to fly.
struct Case {
  std::size_t index = 0;  // in the plan
  std::uint64_t seed = 1;
  std::string scenario_yaml;                      // resolved: it flies by itself
  std::map<std::string, base::Drawn> parameters;  // what varies, by key
};

/// Makes the runs of a plan.
class CaseMaker {
 public:
  /// Throws base::InputError where the scenario or the plan is wrong.
  explicit CaseMaker(SweepPlan plan);

  /// Run `index` of the plan. `quantiles`, one for each of distributions(), take the place of the plan's order.
  Case Make(std::size_t index, const std::vector<double>* quantiles = nullptr) const;

  const SweepPlan& plan() const { return plan_; }
  /// The scenario's name.
  const std::string& name() const { return name_; }
  /// Keys that are distributions, in the order of their names.
  const std::vector<std::string>& distributions() const { return distributions_; }

 private:
  std::vector<base::Override> VariantOf(std::size_t index) const;

  SweepPlan plan_;
  std::string name_;
  std::optional<base::YamlDocument> document_;  // where all runs share one
  std::vector<std::string> distributions_;
  std::vector<std::vector<double>> points_;  // of the order, where it is not random
};

/// "random", "lhs" or "sobol". Throws base::InputError.
Order ParseOrder(const std::string& word);

std::string ToJson(const SweepPlan& plan);
/// Throws base::InputError.
SweepPlan PlanFromJson(const std::string& text);

/// "1-40,77" → 1 … 40, 77. Throws base::InputError.
std::vector<std::uint64_t> ParseSeeds(const std::string& text);
/// "path.to.key=1 kg,2 kg". Throws base::InputError.
GridAxis ParseGrid(const std::string& text);
/// A CSV file: keys first, then a line a run. Throws base::InputError.
void ReadList(const std::string& file, SweepPlan& plan);

}  // namespace alula::scenarios::campaign
