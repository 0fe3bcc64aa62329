#include "scenarios/replay/config_difference.h"

#include <yaml-cpp/yaml.h>

#include "base/config.h"

namespace alula::scenarios::replay {
namespace {

std::string Text(const YAML::Node& node) {
  if (!node.IsDefined()) return "absent";
  YAML::Emitter emitter;
  emitter << YAML::Flow << node;
  return emitter.c_str();
}

std::string Join(const std::string& path, const std::string& key) { return path.empty() ? key : path + "." + key; }

void Compare(const std::string& path, const YAML::Node& a, const YAML::Node& b, std::vector<ConfigDifference>& found);

void CompareMaps(const std::string& path, const YAML::Node& a, const YAML::Node& b,
                 std::vector<ConfigDifference>& found) {
  for (const auto& entry : a) {
    const auto key = entry.first.as<std::string>();
    Compare(Join(path, key), entry.second, b[key], found);
  }
  for (const auto& entry : b) {
    const auto key = entry.first.as<std::string>();
    if (!a[key].IsDefined()) Compare(Join(path, key), a[key], entry.second, found);
  }
}

void CompareLists(const std::string& path, const YAML::Node& a, const YAML::Node& b,
                  std::vector<ConfigDifference>& found) {
  for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i) {
    Compare(Join(path, std::to_string(i)), a[i], b[i], found);
  }
}

void Compare(const std::string& path, const YAML::Node& a, const YAML::Node& b, std::vector<ConfigDifference>& found) {
  if (a.IsDefined() && b.IsDefined() && a.IsMap() && b.IsMap()) return CompareMaps(path, a, b, found);
  if (a.IsDefined() && b.IsDefined() && a.IsSequence() && b.IsSequence()) return CompareLists(path, a, b, found);
  std::string text_a = Text(a), text_b = Text(b);
  if (text_a != text_b) found.push_back({path, std::move(text_a), std::move(text_b)});
}

/// Scalars of the dump are texts with units; the document is our own, so it parses.
YAML::Node Resolved(ScenarioConfig config) {
  config.meaning.clear();
  return YAML::Load(base::DumpConfig(std::move(config)));
}

}  // namespace

std::vector<ConfigDifference> DifferentKeys(const ScenarioConfig& a, const ScenarioConfig& b) {
  std::vector<ConfigDifference> found;
  const YAML::Node node_a = Resolved(a), node_b = Resolved(b);  // const: looking up a key must not make it
  Compare("", node_a, node_b, found);
  return found;
}

}  // namespace alula::scenarios::replay
