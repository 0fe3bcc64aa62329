#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/config.h"
#include "scenarios/slam/estimator_run.h"

namespace alula::scenarios::slam {

/// Estimators to compare. Each text is NAME or NAME:KEY=VALUE,KEY=VALUE…, keys of the scenario's `stack`; none: one
/// called "slam". `scenario`: a scenario's file whose stack is of type slam; empty: the defaults, for recordings.
/// Throws base::InputError for keys that do not exist, two of one name, or a scenario without that stack.
std::vector<Variant> VariantsOf(const std::filesystem::path& scenario, const std::vector<base::Override>& overrides,
                                const std::vector<std::string>& texts, std::uint64_t seed);

}  // namespace alula::scenarios::slam
