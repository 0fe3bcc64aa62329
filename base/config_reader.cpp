#include <algorithm>

#include "base/config.h"
#include "base/internal/value_reader.h"
#include "base/internal/yaml_tree.h"
#include "base/nearest.h"

namespace alula::base {

namespace {

using Bound = Description::Bound;
using yaml_internal::ChoiceIndex;
using yaml_internal::ElementIndex;
using yaml_internal::Fail;
using yaml_internal::IsChoice;
using yaml_internal::JoinPath;
using yaml_internal::Node;
using yaml_internal::Offer;
using yaml_internal::ValueReader;
using yaml_internal::WhatIs;
using Draw = ValueReader::Draw;

/// Walks description and document together. `path` names a field from the top ("vehicle.rotors.0.radius"): in
/// messages, in `--set`, and in the name of the random stream that draws it.
class Reader {
 public:
  Reader(std::uint64_t seed, Draws* draws) : values_(seed, draws) {}

  void ReadStruct(const Node& node, const std::string& path, const Description& description,
                  bool has_type_key = false) {
    if (IsOneValue(description)) return ReadField(description.fields()[0], node, path);
    if (!node.IsMap() && !node.IsNull()) Fail(node, path, "is " + WhatIs(node) + "; a map of keys is wanted");
    RejectUnknownKeys(node, path, description, has_type_key);
    for (const Bound& field : description.fields()) {
      const std::string field_path = JoinPath(path, field.name);
      if (const Node::Entry* entry = node.Find(field.name)) {
        ReadField(field, entry->value, field_path);
      } else if (field.info.required) {
        Fail(node, field_path, "is missing; add it" + Meaning(field.info));
      }
    }
    for (const auto& [key, check] : description.checks()) {
      const std::string wrong = check();
      if (wrong.empty()) continue;
      const Node::Entry* entry = node.Find(key);
      Fail(entry != nullptr ? entry->value : node, JoinPath(path, key), wrong);
    }
  }

 private:
  static std::string Meaning(const FieldInfo& info) {
    return info.meaning.empty() ? "" : " (" + std::string(info.meaning) + ")";
  }

  /// An element that is no struct is described as one field without a name.
  static bool IsOneValue(const Description& description) {
    return description.fields().size() == 1 && description.fields()[0].name.empty();
  }

  static void RejectUnknownKeys(const Node& node, const std::string& path, const Description& description,
                                bool has_type_key) {
    std::vector<std::string> known;
    if (has_type_key) known.emplace_back("type");
    for (const Bound& field : description.fields()) {
      for (const std::string_view reserved : {"type", "extends", "uniform", "normal", "choice"}) {
        if (field.name == reserved) {
          throw FaultError("bad_description",
                           "a field is named `" + field.name + "`, which the reader keeps for itself");
        }
      }
      known.push_back(field.name);
    }
    for (const Node::Entry& entry : node.map) {
      if (std::find(known.begin(), known.end(), entry.key) != known.end()) continue;
      throw InputError(entry.key_where, JoinPath(path, entry.key),
                       "unknown key; " + Suggestion(entry.key, known, "keys"));
    }
  }

  void ReadField(const Bound& field, const Node& node, const std::string& path) {
    if (IsChoice(node)) {
      const Draw draw = values_.DrawChoice(node, path);
      const bool overwrites =
          std::holds_alternative<Bound::Scalar>(field.value) || std::holds_alternative<Bound::Enum>(field.value);
      Draws* const draws = values_.NoteIn(nullptr);       // these are looked at, not drawn
      for (const Node& other : node.map[0].value.list) {  // an error must not wait for the seed that draws it
        if (overwrites) ReadField(field, other, path);
      }
      values_.NoteIn(draws);
      return ReadField(field, *draw.node, draw.path);
    }
    if (field.info.origin != nullptr) *field.info.origin = {node.where, path};
    std::visit([&](const auto& value) { Read(value, field.info, node, path); }, field.value);
  }

  template <typename T>
  void ReadScalar(T* value, const FieldInfo& info, const Node& node, const std::string& path) {
    values_.Read(value, info, node, path);
  }
  void ReadScalar(std::vector<double>* value, const FieldInfo& info, const Node& node, const std::string& path) {
    ReadElements(*value, info, node, path, "numbers");
  }
  void ReadScalar(std::vector<std::string>* value, const FieldInfo& info, const Node& node, const std::string& path) {
    ReadElements(*value, info, node, path, "texts");
  }
  void ReadScalar(std::vector<Vec3>* value, const FieldInfo& info, const Node& node, const std::string& path) {
    ReadElements(*value, info, node, path, "vectors");
  }

  template <typename T>
  void ReadElements(std::vector<T>& values, const FieldInfo& info, const Node& node, const std::string& path,
                    const std::string& plural) {
    const auto read = [&](T& element, const Node& n, const std::string& p) {
      Bound bound{"", info, Bound::Scalar{&element}};
      ReadField(bound, n, p);
    };
    ReadList(
        node, path, plural, [&] { return values.size(); }, [&](std::size_t n) { values.resize(n); },
        [&](std::size_t i, const Node& n, const std::string& p) { read(values[i], n, p); });
  }

  // --- structures ---

  void Read(const Bound::Scalar& scalar, const FieldInfo& info, const Node& node, const std::string& path) {
    std::visit([&](auto* value) { ReadScalar(value, info, node, path); }, scalar);
  }

  void Read(const Bound::Enum& value, const FieldInfo& info, const Node& node, const std::string& path) {
    value.set(ChoiceIndex(node, path, info));
  }

  void Read(const Bound::Struct& value, const FieldInfo&, const Node& node, const std::string& path) {
    Description description;
    value.describe(description);
    ReadStruct(node, path, description);
  }

  void Read(const Bound::Optional& value, const FieldInfo&, const Node& node, const std::string& path) {
    if (node.IsNull()) return value.emplace(false);
    if (!value.present()) value.emplace(true);
    Description description;
    value.describe(description);
    ReadStruct(node, path, description);
  }

  /// A list replaces the default; `--set list.2.key=…` on a list that no file gives changes the default's element.
  template <typename Size, typename Resize, typename ReadOne>
  void ReadList(const Node& node, const std::string& path, const std::string& plural, const Size& size,
                const Resize& resize, const ReadOne& read_one) {
    if (node.IsMap() && node.by_override) {
      for (const Node::Entry& entry : node.map) {
        const int index = ElementIndex(entry, path, size());
        read_one(static_cast<std::size_t>(index), entry.value, JoinPath(path, entry.key));
      }
      return;
    }
    if (!node.IsList()) Fail(node, path, "is " + WhatIs(node) + "; a list of " + plural + " is wanted");
    resize(0);
    resize(node.list.size());
    for (std::size_t i = 0; i < node.list.size(); ++i) {
      read_one(i, node.list[i], JoinPath(path, std::to_string(i)));
    }
  }

  void Read(const Bound::List& list, const FieldInfo&, const Node& node, const std::string& path) {
    ReadList(node, path, "entries", list.size, list.resize,
             [&](std::size_t i, const Node& element, const std::string& element_path) {
               const Draw draw = values_.DrawChoice(element, element_path);
               Description description;
               list.describe(i, description);
               ReadStruct(*draw.node, draw.path, description);
             });
  }

  static void CheckAlternatives(const FieldInfo& info, std::size_t alternatives, const std::string& path) {
    if (info.choices.size() == alternatives) return;
    throw FaultError("bad_description", path + ": has " + std::to_string(alternatives) + " alternatives but " +
                                            std::to_string(info.choices.size()) + " choices");
  }

  /// The alternative that `type` names; `current` where there is no `type` and none is required.
  static std::size_t Alternative(const Node& node, const std::string& path, const FieldInfo& info, std::size_t current,
                                 bool required) {
    if (!node.IsMap() && !node.IsNull())
      Fail(node, path, "is " + WhatIs(node) + "; a map with the key `type` is wanted");
    if (const Node::Entry* type = node.Find("type")) {
      return static_cast<std::size_t>(ChoiceIndex(type->value, JoinPath(path, "type"), info));
    }
    if (!required) return current;
    const std::vector<std::string> words(info.choices.begin(), info.choices.end());
    Fail(node, JoinPath(path, "type"), "is missing; " + Offer("", words));
  }

  void Read(const Bound::OneOf& value, const FieldInfo& info, const Node& node, const std::string& path) {
    CheckAlternatives(info, value.alternatives, path);
    const std::size_t index = Alternative(node, path, info, value.index(), info.required);
    if (index != value.index()) value.emplace(index);
    Description description;
    value.describe(description);
    ReadStruct(node, path, description, true);
  }

  void Read(const Bound::ListOfOneOf& list, const FieldInfo& info, const Node& node, const std::string& path) {
    CheckAlternatives(info, list.alternatives, path);
    const bool patch = node.IsMap();
    ReadList(node, path, "entries", list.size, list.resize,
             [&](std::size_t i, const Node& element, const std::string& element_path) {
               const Draw draw = values_.DrawChoice(element, element_path);
               const std::size_t index = Alternative(*draw.node, draw.path, info, list.index(i), !patch);
               if (index != list.index(i)) list.emplace(i, index);
               Description description;
               list.describe(i, description);
               ReadStruct(*draw.node, draw.path, description, true);
             });
  }

  ValueReader values_;
};

}  // namespace

void ReadDescribed(const YamlDocument& document, Description description, std::uint64_t seed, Draws* draws) {
  Reader(seed, draws).ReadStruct(document.root(), "", description);
}

}  // namespace alula::base
