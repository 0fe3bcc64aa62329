#include "base/internal/yaml_tree.h"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <sstream>
#include <utility>

namespace alula::base {

using Node = YamlDocument::Node;

const Node::Entry* Node::Find(std::string_view key) const {
  for (const Entry& entry : map) {
    if (entry.key == key) return &entry;
  }
  return nullptr;
}

Node::Entry* Node::Find(std::string_view key) { return const_cast<Entry*>(std::as_const(*this).Find(key)); }

void Node::Remove(std::string_view key) {
  std::erase_if(map, [key](const Entry& entry) { return entry.key == key; });
}

bool Node::IsDistribution() const {
  return IsMap() && map.size() == 1 && (map[0].key == "uniform" || map[0].key == "normal" || map[0].key == "choice");
}

namespace yaml_internal {

namespace {

/// Line and column, from 0, of a '[' whose list carries a unit behind its ']'.
using ListUnits = std::map<std::pair<int, int>, std::string>;

/// Takes the units out of `[1, 2, 3] m`, which YAML does not know, and leaves blanks, so that no position moves.
class ListUnitScanner {
 public:
  explicit ListUnitScanner(std::string_view text) : text_(text) {}

  std::pair<std::string, ListUnits> Scan() {
    for (at_ = 0; at_ < text_.size(); Advance()) {
      const char c = text_[at_];
      const bool starts = StartsToken();
      if ((c == '"' || c == '\'') && starts) {
        SkipQuoted(c);
      } else if (c == '#' && (at_ == 0 || IsBlank(text_[at_ - 1]) || text_[at_ - 1] == '\n')) {
        while (at_ + 1 < text_.size() && text_[at_ + 1] != '\n') Advance();
      } else if ((c == '[' || c == '{') && starts) {
        open_.push_back({line_, column_});
      } else if ((c == ']' || c == '}') && !open_.empty()) {
        const auto start = open_.back();
        open_.pop_back();
        if (c == ']') TakeUnit(start);
      }
      if (!IsBlank(c)) before_ = text_[at_];
      if (!IsBlank(c) && c != '-') line_has_token_ = true;
    }
    return {text_, units_};
  }

 private:
  static bool IsBlank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

  void Advance() {
    if (text_[at_] == '\n') {
      ++line_;
      column_ = 0;
      line_has_token_ = false;
    } else if ((static_cast<unsigned char>(text_[at_]) & 0xC0) != 0x80) {
      ++column_;  // yaml-cpp counts characters, not bytes
    }
    ++at_;
  }

  /// A quote or bracket in the middle of a plain word is text.
  bool StartsToken() const {
    if (before_ == '\n' || before_ == '\0') return true;
    if (!open_.empty() && (before_ == ',' || before_ == '[' || before_ == '{')) return true;
    return (before_ == ':' && at_ > 0 && IsBlank(text_[at_ - 1])) || (before_ == '-' && !line_has_token_);
  }

  void SkipQuoted(char quote) {
    Advance();
    while (at_ < text_.size() && text_[at_] != quote) {
      if (quote == '"' && text_[at_] == '\\' && at_ + 1 < text_.size()) Advance();
      Advance();
    }
    if (at_ >= text_.size()) at_ = text_.size() - 1;
  }

  void TakeUnit(std::pair<int, int> start) {
    std::size_t end = at_ + 1;
    while (end < text_.size() && std::string_view(",]}\n#").find(text_[end]) == std::string_view::npos) ++end;
    std::string unit = text_.substr(at_ + 1, end - at_ - 1);
    std::replace_if(unit.begin(), unit.end(), IsBlank, ' ');
    unit.erase(0, unit.find_first_not_of(' '));
    unit.erase(unit.find_last_not_of(' ') + 1);
    if (unit.empty() || unit.find(':') != std::string::npos) return;
    std::size_t blanks = 0;  // as many as the unit has characters: µ is two bytes and one column
    for (std::size_t i = at_ + 1; i < end; ++i) blanks += (static_cast<unsigned char>(text_[i]) & 0xC0) != 0x80;
    text_.replace(at_ + 1, end - at_ - 1, std::string(blanks, ' '));
    units_[start] = unit;
  }

  std::string text_;
  ListUnits units_;
  std::vector<std::pair<int, int>> open_;
  std::size_t at_ = 0;
  int line_ = 0;
  int column_ = 0;
  char before_ = '\0';           // the last character that was no blank
  bool line_has_token_ = false;  // something other than "- " stands before on this line
};

class Converter {
 public:
  Converter(const std::string& file_name, bool with_lines, const ListUnits& units)
      : file_name_(file_name), with_lines_(with_lines), units_(units) {}

  Node Convert(const YAML::Node& yaml, const SourcePosition& fallback, int depth) {
    constexpr int kDeepest = 64;
    constexpr int kMostNodes = 200'000;
    Node node;
    node.where = Where(yaml.Mark(), fallback);
    if (depth > kDeepest) throw InputError(node.where, "", "is nested deeper than 64 levels");
    if (++count_ > kMostNodes) throw InputError(node.where, "", "has more than 200000 values");
    if (yaml.IsScalar()) {
      node.kind = Node::Kind::kScalar;
      node.text = yaml.Scalar();
    } else if (yaml.IsSequence()) {
      node.kind = Node::Kind::kList;
      for (const YAML::Node& element : yaml) node.list.push_back(Convert(element, node.where, depth + 1));
      const auto unit = units_.find({yaml.Mark().line, yaml.Mark().column});
      if (unit != units_.end()) AppendUnit(node, unit->second);
    } else if (yaml.IsMap()) {
      node.kind = Node::Kind::kMap;
      for (const auto& pair : yaml) ConvertEntry(node, pair.first, pair.second, depth);
    }
    return node;
  }

 private:
  SourcePosition Where(const YAML::Mark& mark, const SourcePosition& fallback) const {
    if (!with_lines_) return {file_name_, 0, 0};
    if (mark.is_null()) return fallback;
    return {file_name_, mark.line + 1, mark.column + 1};
  }

  void ConvertEntry(Node& node, const YAML::Node& key, const YAML::Node& value, int depth) {
    const SourcePosition where = Where(key.Mark(), node.where);
    if (!key.IsScalar()) throw InputError(where, "", "a key must be a word");
    if (node.Find(key.Scalar()) != nullptr) throw InputError(where, key.Scalar(), "is given twice; keep one");
    Node converted = Convert(value, where, depth + 1);
    node.map.push_back({key.Scalar(), where, std::move(converted)});
  }

  static void AppendUnit(Node& node, const std::string& unit) {
    if (node.IsScalar()) node.text += " " + unit;
    for (Node& element : node.list) AppendUnit(element, unit);
  }

  const std::string& file_name_;
  bool with_lines_;
  const ListUnits& units_;
  int count_ = 0;
};

/// Follows the parser and builds nothing.
class Silent : public YAML::EventHandler {
 public:
  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
  void OnAlias(const YAML::Mark&, YAML::anchor_t) override {}
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t, const std::string&) override {}
  void OnSequenceStart(const YAML::Mark&, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {}
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark&, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {}
  void OnMapEnd() override {}
};

/// YAML::Load drops what follows the first document, and YAML::LoadAll never ends on a text like ",a".
bool IsOneDocument(const std::string& text) {
  std::istringstream stream(text);
  YAML::Parser parser(stream);
  Silent silent;
  parser.HandleNextDocument(silent);
  return !parser;
}

}  // namespace

Node ParseTree(std::string_view text, const std::string& file_name, bool with_lines) {
  const auto [yaml_text, units] = ListUnitScanner(text).Scan();
  const SourcePosition top{file_name, with_lines ? 1 : 0, with_lines ? 1 : 0};
  try {
    if (!IsOneDocument(yaml_text)) {
      throw InputError(top, "", "is more than one YAML document, or something stands behind its end; one is wanted");
    }
    return Converter(file_name, with_lines, units).Convert(YAML::Load(yaml_text), top, 0);
  } catch (const YAML::Exception& error) {
    SourcePosition where = top;
    if (with_lines && !error.mark.is_null()) where = {file_name, error.mark.line + 1, error.mark.column + 1};
    throw InputError(where, "", "is not valid YAML: " + error.msg);
  }
}

Node NullAt(const SourcePosition& where) {
  Node node;
  node.where = where;
  return node;
}

Node Merge(const Node& base, const Node& over) {
  if (!base.IsMap() || !over.IsMap() || base.IsDistribution() || over.IsDistribution()) return over;
  const Node::Entry* base_type = base.Find("type");
  const Node::Entry* over_type = over.Find("type");
  if (base_type != nullptr && over_type != nullptr && base_type->value.text != over_type->value.text) return over;
  Node merged = base;
  merged.where = over.where;
  merged.by_override = base.by_override && over.by_override;
  for (const Node::Entry& entry : over.map) {
    if (Node::Entry* present = merged.Find(entry.key)) {
      *present = {entry.key, entry.key_where, Merge(present->value, entry.value)};
    } else {
      merged.map.push_back(entry);
    }
  }
  return merged;
}

std::string WhatIs(const Node& node) {
  constexpr std::size_t kLongest = 60;
  switch (node.kind) {
    case Node::Kind::kNull:
      return "nothing";
    case Node::Kind::kScalar:
      return "`" + (node.text.size() <= kLongest ? node.text : node.text.substr(0, kLongest) + "…") + "`";
    case Node::Kind::kList:
      return "a list";
    case Node::Kind::kMap:
      return "a map";
  }
  return "";
}

std::string JoinPath(std::string_view path, std::string_view key) {
  if (path.empty() || key.empty()) return std::string(path) + std::string(key);
  return std::string(path) + "." + std::string(key);
}

int ParseIndex(std::string_view text) {
  int index = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), index);
  return error == std::errc{} && end == text.data() + text.size() && index >= 0 ? index : -1;
}

}  // namespace yaml_internal

}  // namespace alula::base
