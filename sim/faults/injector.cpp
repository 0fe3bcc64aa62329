#include "sim/faults/injector.h"

#include <algorithm>
#include <map>
#include <set>

#include "base/error.h"

namespace alula::sim::faults {
namespace {

template <typename... Kinds>
std::vector<std::string_view> Types(const std::variant<Kinds...>*) {
  return {Kinds::kType...};
}

const Timing& TimingOf(const Config& config) {
  return std::visit([](const auto& c) -> const Timing& { return c; }, config);
}

std::string_view TypeOf(const Config& config) {
  return std::visit([](const auto& c) { return std::decay_t<decltype(c)>::kType; }, config);
}

/// A fault without a name of its own is "drop 0", "drop 1", …: of its kind, so that another kind shifts no stream.
std::vector<std::string> NamesOf(const std::vector<Config>& configs) {
  std::vector<std::string> names;
  std::map<std::string_view, int> count;
  std::set<std::string> seen;
  for (const Config& config : configs) {
    const Timing& timing = TimingOf(config);
    const int number = count[TypeOf(config)]++;
    names.push_back(timing.name.empty() ? std::string(TypeOf(config)) + " " + std::to_string(number) : timing.name);
    if (seen.insert(names.back()).second) continue;
    const base::Origin& origin = timing.name_origin;
    throw base::InputError(origin.where, origin.path.empty() ? "faults" : origin.path,
                           "two faults are called `" + names.back() + "`; rename one");
  }
  return names;
}

}  // namespace

void DescribeFaults(base::Description& d, std::vector<Config>& faults) {
  d.ListOf("faults", faults,
           {.meaning = "what goes wrong, and when", .choices = Types(static_cast<const Config*>(nullptr))});
}

Injector::Injector(const std::vector<Config>& configs, const Scope& scope, std::uint64_t seed) {
  const std::vector<std::string> names = NamesOf(configs);
  for (std::size_t i = 0; i < configs.size(); ++i) {
    CheckTiming(TimingOf(configs[i]), scope);
    entries_.push_back({names[i], Onset(TimingOf(configs[i]), seed, names[i]),
                        std::visit([&](const auto& c) { return Make(c, scope, seed, names[i]); }, configs[i])});
  }
}

bool Injector::Advance(const Situation& situation) {
  events_.clear();
  bool changed = false;
  for (Entry& entry : entries_) {
    const bool lasted = entry.lasts;
    entry.lasts = entry.onset.Lasts(situation);
    if (entry.lasts == lasted) continue;
    changed = true;
    Say(situation.now, entry.lasts ? "fault_begin" : "fault_end", entry.name + ": " + entry.fault->Words());
  }
  if (!changed) return false;
  impairments_ = {};
  for (const Entry& entry : entries_) {
    if (entry.lasts) entry.fault->Impair(impairments_);
  }
  return true;
}

void Injector::Say(base::Time now, std::string kind, std::string text) {
  events_.push_back({now, std::move(kind), std::move(text)});
}

bool Injector::Take(stack::Measurement& measurement, Numbers& struck_by) {
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    Entry& entry = entries_[i];
    if (!entry.lasts || !entry.fault->Concerns(measurement.sensor)) continue;
    if (!entry.fault->Take(measurement)) return false;
    struck_by.push_back(static_cast<std::uint16_t>(i));
  }
  return true;
}

void Injector::Arrive(stack::Measurement& measurement, const Numbers& struck_by) {
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    Fault& fault = *entries_[i].fault;
    if (!fault.Concerns(measurement.sensor)) continue;
    fault.Arrive(measurement, std::find(struck_by.begin(), struck_by.end(), i) != struck_by.end());
  }
}

}  // namespace alula::sim::faults
