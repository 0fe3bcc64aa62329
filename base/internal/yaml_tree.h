#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/config.h"
#include "base/error.h"

namespace alula::base {

/// One node of a YAML document with its place in the file: a plain tree, free of aliases.
struct YamlDocument::Node {
  enum class Kind { kNull, kScalar, kList, kMap };
  struct Entry;

  Kind kind = Kind::kNull;
  SourcePosition where;
  std::string text;          // of a scalar
  bool by_override = false;  // a map that `--set` made on the way to its key
  std::vector<Node> list;
  std::vector<Entry> map;  // in the order of the file

  bool IsNull() const { return kind == Kind::kNull; }
  bool IsScalar() const { return kind == Kind::kScalar; }
  bool IsList() const { return kind == Kind::kList; }
  bool IsMap() const { return kind == Kind::kMap; }

  const Entry* Find(std::string_view key) const;
  Entry* Find(std::string_view key);
  void Remove(std::string_view key);
  /// {uniform: …}, {normal: …} or {choice: …}: stands for a value.
  bool IsDistribution() const;
};

struct YamlDocument::Node::Entry {
  std::string key;
  SourcePosition key_where;
  Node value;
};

namespace yaml_internal {

using Node = YamlDocument::Node;

/// Parses one YAML document. `[1, 2, 3] m` is read as `[1 m, 2 m, 3 m]`. Duplicate keys, several documents and more
/// than 200000 nodes are errors. With `with_lines` false, nodes carry the file name only (text of `--set`).
Node ParseTree(std::string_view text, const std::string& file_name, bool with_lines = true);

/// A node that holds nothing yet.
Node NullAt(const SourcePosition& where);

/// `over` on top of `base`: maps merge; scalars, lists, distributions, and maps of another `type` replace.
Node Merge(const Node& base, const Node& over);

/// "map", "list", "`text`", "nothing": what stands there, for messages.
std::string WhatIs(const Node& node);

/// Joins with a dot; an empty part adds nothing.
std::string JoinPath(std::string_view path, std::string_view key);

/// A list index; −1 when the text is none.
int ParseIndex(std::string_view text);

}  // namespace yaml_internal

}  // namespace alula::base
