#include "scenarios/slam/variants.h"

#include <algorithm>
#include <variant>

#include "base/error.h"
#include "scenarios/scenario.h"

namespace alula::scenarios::slam {
namespace {

using base::Override;
using stack::pilot::SlamStackConfig;

/// What a recording is estimated with: a scenario of which there is only the stack.
struct StackPart {
  SlamStackConfig stack;
};
void Describe(base::Description& d, StackPart& c) { d.Field("stack", c.stack, {.meaning = "the estimator"}); }

stack::slam::SlamConfig Read(const std::filesystem::path& scenario, const std::vector<Override>& overrides,
                             std::uint64_t seed) {
  if (scenario.empty()) {
    const base::YamlDocument document = base::YamlDocument::Parse("{}", "defaults", Catalogs(), overrides);
    return base::ReadConfig<StackPart>(document, seed).stack.slam;
  }
  const StackConfig stack = LoadScenario(scenario, overrides, seed).config.stack;
  if (const auto* slam = std::get_if<SlamStackConfig>(&stack)) return slam->slam;
  throw base::InputError(scenario.string() + ": its stack is not of type slam; --set stack.type=slam estimates along");
}

/// "odometry.window.frames=8,odometry.window.huber=2" → overrides below `stack`. Commas inside brackets do not part.
std::vector<Override> KeysOf(const std::string& text, const std::string& whole) {
  std::vector<Override> keys;
  int depth = 0;
  std::string one;
  const auto take = [&] {
    const std::size_t equals = one.find('=');
    if (equals == std::string::npos || equals == 0)
      throw base::InputError("--variant " + whole + ": must be NAME:key=value,key=value");
    keys.push_back({"stack." + one.substr(0, equals), one.substr(equals + 1)});
    one.clear();
  };
  for (const char c : text) {
    depth += c == '[' || c == '{' ? 1 : c == ']' || c == '}' ? -1 : 0;
    if (c == ',' && depth == 0) {
      take();
    } else {
      one += c;
    }
  }
  if (!one.empty()) take();
  return keys;
}

}  // namespace

std::vector<Variant> VariantsOf(const std::filesystem::path& scenario, const std::vector<Override>& overrides,
                                const std::vector<std::string>& texts, std::uint64_t seed) {
  std::vector<Variant> variants;
  for (const std::string& text : texts.empty() ? std::vector<std::string>{"slam"} : texts) {
    const std::size_t colon = text.find(':');
    Variant variant;
    variant.name = text.substr(0, colon);
    const auto plain = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-'; };
    if (variant.name.empty() || !std::all_of(variant.name.begin(), variant.name.end(), plain))
      throw base::InputError("--variant " + text + ": the name must be of letters, digits, _ and -");
    if (std::any_of(variants.begin(), variants.end(), [&](const Variant& v) { return v.name == variant.name; }))
      throw base::InputError("--variant " + text + ": there are two of this name");
    std::vector<Override> all = overrides;
    if (colon != std::string::npos) {
      for (Override& key : KeysOf(text.substr(colon + 1), text)) all.push_back(std::move(key));
    }
    variant.config = Read(scenario, all, seed);
    variants.push_back(std::move(variant));
  }
  return variants;
}

}  // namespace alula::scenarios::slam
