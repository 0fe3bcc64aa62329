#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/describe.h"

namespace alula::base {

/// `--set path.to.key=value`.
struct Override {
  std::string path;
  std::string value;
};

/// A YAML file with positions, `extends:` resolved (at the top and in any nested map) and overrides applied.
///
/// `extends: ../other.yaml` (from the folder of the file that says it) or `extends: q250` (a catalog name). Maps merge;
/// scalars, lists, distributions and maps whose `type` differs replace. Of two `extends` for one map the upper counts,
/// so `--set vehicle.extends=q500` swaps the vehicle and keeps what the scenario changed in it.
class YamlDocument {
 public:
  /// `catalogs`: folders in which a name without a slash is looked up ("q250" → q250.yaml) by `extends:`.
  /// Throws InputError with file:line:col.
  static YamlDocument Load(const std::filesystem::path& file, const std::vector<std::filesystem::path>& catalogs,
                           const std::vector<Override>& overrides = {});
  static YamlDocument Parse(std::string_view text, std::string_view file_name,
                            const std::vector<std::filesystem::path>& catalogs = {},
                            const std::vector<Override>& overrides = {});

  YamlDocument(YamlDocument&&) noexcept;
  YamlDocument& operator=(YamlDocument&&) noexcept;
  ~YamlDocument();

  struct Node;
  const Node& root() const { return *root_; }

 private:
  YamlDocument();
  std::shared_ptr<const Node> root_;
};

/// One distribution of a document, and what was drawn from it.
struct Drawn {
  std::string kind;     // "uniform", "normal" or "choice"
  std::string value;    // with its unit, as it would stand in the file; of a choice of maps or lists the entry's number
  double number = 0.0;  // in SI; of a choice the entry's number
};

/// Where the random part of distributions comes from, and what came of it.
struct Draws {
  /// The share u in (0, 1) of its distribution at which the value of a path lies: the value is the u-quantile (of a
  /// choice, entry ⌊u n⌋). Where there is no function, or it gives none, the stream "parameter/<path>" draws.
  std::function<std::optional<double>(const std::string& path)> quantile;
  std::map<std::string, Drawn> drawn;  // by path
};

/// Fills the described struct from the document. Distributions ({uniform: […]}, {normal: […]}, {choice: […]}) are
/// drawn from streams named "parameter/<path>" of `seed`. Unknown keys, wrong dimensions, values outside their range
/// and failed checks throw InputError with file:line:col, the nearest known key suggested.
void ReadDescribed(const YamlDocument& document, Description description, std::uint64_t seed, Draws* draws = nullptr);

/// The struct as YAML: every field, units written out, numbers with as many digits as read back to the same bits.
std::string DumpDescribed(const Description& description);

/// JSON Schema (draft 2020-12) of the struct, for editors. Walks every alternative of every OneOf through the described
/// instance, so give it one of its own.
std::string SchemaOf(const Description& description, std::string_view title);

template <Describable Config>
Config ReadConfig(const YamlDocument& document, std::uint64_t seed, Draws* draws = nullptr) {
  Config config;
  Description description;
  Describe(description, config);
  ReadDescribed(document, std::move(description), seed, draws);
  return config;
}

template <Describable Config>
std::string DumpConfig(Config config) {
  Description description;
  Describe(description, config);
  return DumpDescribed(description);
}

template <Describable Config>
std::string SchemaOfConfig(std::string_view title) {
  Config config;
  Description description;
  Describe(description, config);
  return SchemaOf(description, title);
}

}  // namespace alula::base
