#include <algorithm>
#include <fstream>
#include <sstream>
#include <system_error>

#include "base/config.h"
#include "base/internal/yaml_tree.h"
#include "base/nearest.h"

namespace alula::base {

namespace {

namespace fs = std::filesystem;
using yaml_internal::JoinPath;
using yaml_internal::Merge;
using yaml_internal::Node;
using yaml_internal::NullAt;
using yaml_internal::ParseIndex;
using yaml_internal::ParseTree;
using yaml_internal::WhatIs;

Node LoadTree(const fs::path& file) {
  std::error_code error;
  if (fs::is_directory(file, error)) throw InputError({file.string()}, "", "is a folder; a YAML file is wanted");
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  if (!stream || !(text << stream.rdbuf() || stream.peek() == std::ifstream::traits_type::eof())) {
    throw InputError({file.string()}, "", "cannot be read; is the name right?");
  }
  return ParseTree(text.str(), file.string());
}

Node& EnsureMap(Node& node, const SourcePosition& where) {
  if (node.IsNull()) {
    node.kind = Node::Kind::kMap;
    node.where = where;
    node.by_override = true;
  }
  return node;
}

/// One `--set`, split and parsed.
struct Setting {
  std::vector<std::string> path;
  Node value;

  const std::string& key() const { return path.back(); }
};

std::vector<Setting> ParseSettings(const std::vector<Override>& overrides) {
  std::vector<Setting> settings;
  for (const Override& given : overrides) {
    const std::string label = "--set " + given.path + "=" + given.value;
    Setting setting;
    std::istringstream parts(given.path);
    for (std::string part; std::getline(parts, part, '.');) setting.path.push_back(part);
    if (setting.path.empty() || given.path.back() == '.' ||
        std::find(setting.path.begin(), setting.path.end(), "") != setting.path.end()) {
      throw InputError({label}, "", "names no key; write --set path.to.key=value");
    }
    setting.value = ParseTree(given.value, label, false);
    settings.push_back(std::move(setting));
  }
  // A `type` clears the keys of the type before it, so it comes before the keys of the new one.
  std::stable_sort(settings.begin(), settings.end(), [](const Setting& a, const Setting& b) {
    const auto rank = [](const Setting& s) { return s.key() == "type" ? s.path.size() : std::size_t{1000}; };
    return rank(a) < rank(b);
  });
  return settings;
}

void ApplySetting(Node& root, const Setting& setting) {
  const SourcePosition& where = setting.value.where;
  Node* node = &root;
  std::string path;
  for (std::size_t i = 0; i < setting.path.size(); ++i) {
    const std::string& part = setting.path[i];
    EnsureMap(*node, where);
    if (node->IsScalar()) {
      throw InputError(where, JoinPath(path, part), "`" + path + "` is " + WhatIs(*node) + ", which has no keys");
    }
    path = JoinPath(path, part);
    if (node->IsList()) {
      const int index = ParseIndex(part);
      const std::size_t size = node->list.size();
      if (index < 0 || static_cast<std::size_t>(index) >= size) {
        throw InputError(where, path,
                         size == 0 ? std::string("the list is empty")
                                   : "the list has the elements 0 to " + std::to_string(size - 1));
      }
      node = &node->list[static_cast<std::size_t>(index)];
      continue;
    }
    const bool last = i + 1 == setting.path.size();
    Node::Entry* entry = node->Find(part);
    if (last && part == "type" && entry != nullptr && entry->value.text != setting.value.text) {
      node->map.clear();
      entry = nullptr;
    }
    if (entry == nullptr) {
      node->map.push_back({part, where, NullAt(where)});
      entry = &node->map.back();
    }
    entry->key_where = where;
    node = &entry->value;
  }
  *node = Merge(*node, setting.value);
}

/// Resolves `extends:`. It is a key like any other until then: of several, the one on top counts. So that
/// `--set vehicle.extends=q500` swaps the whole vehicle, those settings go in before their map is resolved.
class Extender {
 public:
  Extender(const std::vector<fs::path>& catalogs, const std::vector<Setting>& settings) : catalogs_(catalogs) {
    for (const Setting& setting : settings) {
      if (setting.key() == "extends") settings_.push_back(setting);
    }
  }

  void Resolve(Node& node, const std::vector<std::string>& path) {
    SetOwnExtends(node, path);
    const std::size_t depth = chain_.size();
    while (node.IsMap()) {
      const Node::Entry* entry = node.Find("extends");
      if (entry == nullptr) break;
      const Node statement = entry->value;
      node.Remove("extends");
      const fs::path file = Locate(statement);
      CheckCircle(statement, file);
      chain_.push_back({statement.where, file});
      Node below = LoadTree(file);
      if (below.IsNull()) below.kind = Node::Kind::kMap;
      if (!below.IsMap())
        throw InputError(below.where, "", "is " + WhatIs(below) + "; `extends` wants a file with a map");
      node = Merge(below, node);
    }
    MakeWay(node, path);
    for (std::size_t i = 0; i < node.list.size(); ++i) Descend(node.list[i], path, std::to_string(i));
    for (Node::Entry& entry : node.map) Descend(entry.value, path, entry.key);
    chain_.resize(depth);
  }

 private:
  struct Link {
    SourcePosition statement;
    fs::path file;
  };

  void Descend(Node& node, std::vector<std::string> path, const std::string& key) {
    if (!node.IsMap() && !node.IsList() && !node.IsNull()) return;
    path.push_back(key);
    Resolve(node, path);
  }

  /// The settings below `path`, each with the part of its path that follows.
  template <typename Function>
  void ForSettingsBelow(const std::vector<std::string>& path, const Function& function) const {
    for (const Setting& setting : settings_) {
      if (setting.path.size() <= path.size() || !std::equal(path.begin(), path.end(), setting.path.begin())) continue;
      function(setting, setting.path[path.size()], setting.path.size() == path.size() + 1);
    }
  }

  void SetOwnExtends(Node& node, const std::vector<std::string>& path) const {
    ForSettingsBelow(path, [&](const Setting& setting, const std::string& part, bool last) {
      if (!last || node.IsList() || node.IsScalar()) return;
      EnsureMap(node, setting.value.where);
      node.Remove("extends");
      node.map.push_back({part, setting.value.where, setting.value});
    });
  }

  /// The way to an `extends` in a map that no file mentions.
  void MakeWay(Node& node, const std::vector<std::string>& path) const {
    ForSettingsBelow(path, [&](const Setting& setting, const std::string& part, bool last) {
      if (last || node.IsList() || node.IsScalar()) return;
      EnsureMap(node, setting.value.where);
      if (node.Find(part) != nullptr) return;
      node.map.push_back({part, setting.value.where, NullAt(setting.value.where)});
    });
  }

  fs::path Locate(const Node& statement) const {
    const SourcePosition& where = statement.where;
    if (!statement.IsScalar() || statement.text.empty()) {
      throw InputError(where, "extends", "is " + WhatIs(statement) + "; a file or a catalog name is wanted");
    }
    const std::string& name = statement.text;
    const bool is_path = name.find('/') != std::string::npos || name.ends_with(".yaml") || name.ends_with(".yml");
    std::error_code error;
    if (is_path) {
      const fs::path folder = where.line > 0 ? fs::path(where.file).parent_path() : fs::path();
      const fs::path file = (folder / name).lexically_normal();
      if (fs::exists(file, error)) return file;
      throw InputError(where, "extends", "there is no file `" + file.string() + "`");
    }
    std::vector<std::string> known;
    for (const fs::path& catalog : catalogs_) {
      const fs::path file = catalog / (name + ".yaml");
      if (fs::exists(file, error)) return file.lexically_normal();
      for (fs::directory_iterator it(catalog, error), end; !error && it != end; it.increment(error)) {
        if (it->path().extension() == ".yaml") known.push_back(it->path().stem().string());
      }
    }
    std::sort(known.begin(), known.end());
    throw InputError(where, "extends",
                     "there is no `" + name + "` in the catalogs; " + Suggestion(name, known, "names"));
  }

  void CheckCircle(const Node& statement, const fs::path& file) const {
    for (const Link& link : chain_) {
      const SourcePosition& at = link.statement;
      const bool same = at.file == statement.where.file && at.line == statement.where.line &&
                        at.column == statement.where.column && link.file == file;
      if (!same) continue;
      std::string circle = statement.where.file;
      for (std::size_t i = static_cast<std::size_t>(&link - chain_.data()); i < chain_.size(); ++i) {
        circle += " → " + chain_[i].file.string();
      }
      throw InputError(statement.where, "extends", "goes round in a circle: " + circle);
    }
    constexpr std::size_t kLongestChain = 64;
    if (chain_.size() > kLongestChain) {
      throw InputError(statement.where, "extends", "is nested deeper than 64 files");
    }
  }

  const std::vector<fs::path>& catalogs_;
  std::vector<Setting> settings_;
  std::vector<Link> chain_;
};

Node Finish(Node root, const std::vector<fs::path>& catalogs, const std::vector<Override>& overrides) {
  if (root.IsNull()) root.kind = Node::Kind::kMap;
  if (!root.IsMap()) throw InputError(root.where, "", "is " + WhatIs(root) + "; a map of keys is wanted");
  const std::vector<Setting> settings = ParseSettings(overrides);
  Extender(catalogs, settings).Resolve(root, {});
  for (const Setting& setting : settings) {
    if (setting.key() != "extends") ApplySetting(root, setting);
  }
  return root;
}

}  // namespace

YamlDocument::YamlDocument() = default;
YamlDocument::YamlDocument(YamlDocument&&) noexcept = default;
YamlDocument& YamlDocument::operator=(YamlDocument&&) noexcept = default;
YamlDocument::~YamlDocument() = default;

YamlDocument YamlDocument::Load(const fs::path& file, const std::vector<fs::path>& catalogs,
                                const std::vector<Override>& overrides) {
  YamlDocument document;
  document.root_ = std::make_shared<const Node>(Finish(LoadTree(file), catalogs, overrides));
  return document;
}

YamlDocument YamlDocument::Parse(std::string_view text, std::string_view file_name,
                                 const std::vector<fs::path>& catalogs, const std::vector<Override>& overrides) {
  YamlDocument document;
  document.root_ = std::make_shared<const Node>(Finish(ParseTree(text, std::string(file_name)), catalogs, overrides));
  return document;
}

}  // namespace alula::base
