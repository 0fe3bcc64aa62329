#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/config.h"
#include "base/internal/quantity.h"
#include "base/internal/yaml_tree.h"
#include "base/nearest.h"
#include "base/random.h"

namespace alula::base {

namespace {

using Bound = Description::Bound;
using yaml_internal::JoinPath;
using yaml_internal::Node;
using yaml_internal::ParseIndex;
using yaml_internal::WhatIs;

/// Walks description and document together. `path` names a field from the top ("vehicle.rotors.0.radius"): in
/// messages, in `--set`, and in the name of the random stream that draws it.
class Reader {
 public:
  explicit Reader(std::uint64_t seed) : seed_(seed) {}

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
  [[noreturn]] static void Fail(const Node& node, std::string_view path, const std::string& message) {
    throw InputError(node.where, path, message);
  }

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
      const Draw draw = DrawChoice(node, path);
      const bool overwrites =
          std::holds_alternative<Bound::Scalar>(field.value) || std::holds_alternative<Bound::Enum>(field.value);
      for (const Node& other : node.map[0].value.list) {  // an error must not wait for the seed that draws it
        if (overwrites) ReadField(field, other, path);
      }
      return ReadField(field, *draw.node, draw.path);
    }
    std::visit([&](const auto& value) { Read(value, field.info, node, path); }, field.value);
  }

  static bool IsChoice(const Node& node) { return node.IsDistribution() && node.map[0].key == "choice"; }

  struct Draw {
    const Node* node;
    std::string path;
  };

  /// The entry that the seed draws from {choice: […]}; any other node is itself.
  Draw DrawChoice(const Node& node, const std::string& path) const {
    if (!IsChoice(node)) return {&node, path};
    const Node& choices = node.map[0].value;
    if (!choices.IsList() || choices.list.empty()) {
      Fail(choices, path, "`choice` wants a list of at least one value");
    }
    RandomStream stream(seed_, "parameter/" + path);
    const std::size_t drawn = static_cast<std::size_t>(stream.Index(choices.list.size()));
    return DrawChoice(choices.list[drawn], path + ".choice." + std::to_string(drawn));
  }

  // --- values ---

  static constexpr const char* kNumberOrDistribution = "a number, {uniform: …}, {normal: …} or {choice: …}";

  static const std::string& ScalarText(const Node& node, const std::string& path, const char* wanted) {
    if (node.IsNull()) Fail(node, path, std::string("has no value; ") + wanted + " is wanted");
    if (!node.IsScalar()) Fail(node, path, "is " + WhatIs(node) + "; " + wanted + " is wanted");
    return node.text;
  }

  /// Runs a parser of quantity.h and adds file, line, column and key to what it has to say.
  template <typename Function>
  static auto Located(const Node& node, const std::string& path, const Function& function) {
    try {
      return function();
    } catch (const InputError& error) {
      Fail(node, path, error.what());
    } catch (const FaultError& error) {
      throw FaultError(error.reason(), path + ": " + error.what());
    }
  }

  /// Draws where `node` is a distribution, reads otherwise; either way within the field's range. `parse` gives a
  /// number of the field's kind as a double, `round` brings a drawn one back to a value the field can hold.
  template <typename Parse, typename Round>
  double NumberOrDraw(const Node& node, const std::string& path, const FieldInfo& info, std::string_view unit,
                      const Parse& parse, const Round& round) {
    const auto read = [&](const Node& n) {
      const std::string& text = ScalarText(n, path, n.IsMap() ? kNumberOrDistribution : "a number");
      return Located(n, path, [&] { return parse(text); });
    };
    const auto checked = [&](const Node& n, double value) {
      Located(n, path, [&] { quantity::CheckRange(value, info, unit, n.text); });
      return value;
    };
    if (!node.IsDistribution()) return checked(node, read(node));
    const std::string& kind = node.map[0].key;
    const Node& arguments = node.map[0].value;
    RandomStream stream(seed_, "parameter/" + path);
    if (kind == "choice") {
      const Draw draw = DrawChoice(node, path);
      return NumberOrDraw(*draw.node, draw.path, info, unit, parse, round);
    }
    if (!arguments.IsList() || arguments.list.size() != 2) {
      Fail(arguments, path,
           kind == "uniform" ? "`uniform` wants [lowest, highest]" : "`normal` wants [mean, standard deviation]");
    }
    const double first = read(arguments.list[0]);
    const double second = read(arguments.list[1]);
    if (kind == "uniform") {
      if (first > second) Fail(arguments, path, "`uniform` wants the lowest value first");
      checked(arguments.list[0], first);
      checked(arguments.list[1], second);
      return std::clamp(round(stream.Uniform(first, second), first, second, stream), first, second);
    }
    checked(arguments.list[0], first);
    if (second < 0) Fail(arguments.list[1], path, "a standard deviation cannot be negative");
    constexpr int kMostDraws = 1000;  // the mean lies in the range, so half of the draws do on one side at least
    for (int i = 0; i < kMostDraws; ++i) {
      const double value = round(first + second * stream.Gaussian(), info.min, info.max, stream);
      if (value >= info.min && value <= info.max) return value;
    }
    Fail(arguments, path, "almost never falls into its range; lower the standard deviation");
  }

  double ReadDouble(const Node& node, const std::string& path, const FieldInfo& info, bool may_be_infinite) {
    return NumberOrDraw(
        node, path, info, info.unit,
        [&](const std::string& text) { return quantity::ParseNumber(text, info.unit, may_be_infinite); },
        [](double value, double, double, RandomStream&) { return value; });
  }

  /// `uniform` over integers takes both ends with the same chance as all between.
  static double RoundInteger(double value, double low, double high, RandomStream& stream) {
    if (std::isfinite(low) && std::isfinite(high) && value >= low && value <= high && high - low < 0x1p52) {
      return low + static_cast<double>(stream.Index(static_cast<std::uint64_t>(high - low) + 1));
    }
    return std::round(value);
  }

  template <typename Integer>
  Integer ReadInteger(const Node& node, const std::string& path, const FieldInfo& info) {
    FieldInfo limits = info;
    limits.min = std::max(limits.min, static_cast<double>(std::numeric_limits<Integer>::min()));
    limits.max = std::min(limits.max, static_cast<double>(std::numeric_limits<Integer>::max()));
    const auto parse = [&](const std::string& text) {
      if constexpr (std::is_unsigned_v<Integer>) {
        return quantity::ParseUnsigned(text, info.unit);
      } else {
        return quantity::ParseInteger(text, info.unit);
      }
    };
    if (!node.IsDistribution()) {  // as an integer, not through a double: seeds have 64 bits
      const std::string& text = ScalarText(node, path, "a whole number");
      const auto value = Located(node, path, [&] { return parse(text); });
      Located(node, path, [&] { quantity::CheckRange(static_cast<double>(value), limits, info.unit, text); });
      return static_cast<Integer>(value);
    }
    const bool uniform = node.map[0].key == "uniform";
    return static_cast<Integer>(NumberOrDraw(
        node, path, limits, info.unit, [&](const std::string& text) { return static_cast<double>(parse(text)); },
        [uniform](double value, double low, double high, RandomStream& stream) {
          return uniform ? RoundInteger(value, low, high, stream) : std::round(value);
        }));
  }

  void ReadScalar(double* value, const FieldInfo& info, const Node& node, const std::string& path) {
    *value = ReadDouble(node, path, info, std::isinf(*value));
  }
  void ReadScalar(int* value, const FieldInfo& info, const Node& node, const std::string& path) {
    *value = ReadInteger<int>(node, path, info);
  }
  void ReadScalar(std::int64_t* value, const FieldInfo& info, const Node& node, const std::string& path) {
    *value = ReadInteger<std::int64_t>(node, path, info);
  }
  void ReadScalar(std::uint64_t* value, const FieldInfo& info, const Node& node, const std::string& path) {
    *value = ReadInteger<std::uint64_t>(node, path, info);
  }
  void ReadScalar(bool* value, const FieldInfo&, const Node& node, const std::string& path) {
    const std::string& text = ScalarText(node, path, "true or false");
    if (text != "true" && text != "false") Fail(node, path, WhatIs(node) + " is neither `true` nor `false`");
    *value = text == "true";
  }
  void ReadScalar(std::string* value, const FieldInfo& info, const Node& node, const std::string& path) {
    const std::string& text = ScalarText(node, path, "a text");
    if (!info.choices.empty()) ChoiceIndex(node, path, info);
    *value = text;
    if (!info.is_path || text.empty() || std::filesystem::path(text).is_absolute()) return;
    const std::filesystem::path folder =
        node.where.line > 0 ? std::filesystem::path(node.where.file).parent_path() : std::filesystem::path();
    *value = std::filesystem::absolute(folder / text).lexically_normal().string();
  }
  void ReadScalar(Duration* value, const FieldInfo& info, const Node& node, const std::string& path) {
    const double seconds = NumberOrDraw(
        node, path, info, "s", [](const std::string& text) { return quantity::ParseDuration(text).Seconds(); },
        [](double drawn, double, double, RandomStream&) { return drawn; });
    *value = node.IsScalar() ? quantity::ParseDuration(node.text) : Seconds(seconds);
  }
  void ReadScalar(Rate* value, const FieldInfo& info, const Node& node, const std::string& path) {
    const std::string& text = ScalarText(node, path, "a frequency");
    const Rate rate = Located(node, path, [&] { return quantity::ParseRate(text); });
    Located(node, path, [&] { quantity::CheckRange(rate.Hz(), info, "Hz", text); });
    *value = rate;
  }
  void ReadScalar(Vec3* value, const FieldInfo& info, const Node& node, const std::string& path) {
    if (node.by_override && node.IsMap()) return PatchVec3(value, info, node, path);
    if (node.IsDistribution()) return DrawVec3(value, info, node, path);
    if (!node.IsList() || node.list.size() != 3) {
      const std::string what = node.IsList() ? std::to_string(node.list.size()) + " values" : WhatIs(node);
      Fail(node, path, "is " + what + "; a list of three is wanted, for example `" + ExampleVec3(info) + "`");
    }
    for (int i = 0; i < 3; ++i) {
      const Node& element = node.list[static_cast<std::size_t>(i)];
      (*value)[i] = ReadDouble(element, JoinPath(path, std::to_string(i)), info, std::isinf((*value)[i]));
    }
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

  static std::string ExampleVec3(const FieldInfo& info) {
    return info.unit == "1" ? "[0, 0, 1]" : "[0, 0, 1] " + std::string(info.unit);
  }

  void PatchVec3(Vec3* value, const FieldInfo& info, const Node& node, const std::string& path) {
    for (const Node::Entry& entry : node.map) {
      const int index = ElementIndex(entry, path, 3);
      (*value)[index] = ReadDouble(entry.value, JoinPath(path, entry.key), info, false);
    }
  }

  /// {uniform: [[…], […]]} draws each component by itself.
  void DrawVec3(Vec3* value, const FieldInfo& info, const Node& node, const std::string& path) {
    const Node& arguments = node.map[0].value;
    const auto is_vector = [](const Node& n) { return n.IsList() && n.list.size() == 3; };
    if (!arguments.IsList() || arguments.list.size() != 2 || !is_vector(arguments.list[0]) ||
        !is_vector(arguments.list[1])) {
      Fail(arguments, path, "`" + node.map[0].key + "` of a vector wants two lists of three");
    }
    for (std::size_t i = 0; i < 3; ++i) {
      Node component = node;
      component.map[0].value.list = {arguments.list[0].list[i], arguments.list[1].list[i]};
      (*value)[static_cast<int>(i)] = ReadDouble(component, JoinPath(path, std::to_string(i)), info, false);
    }
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

  static int ChoiceIndex(const Node& node, const std::string& path, const FieldInfo& info) {
    const std::string& text = ScalarText(node, path, "a word");
    const std::vector<std::string> words(info.choices.begin(), info.choices.end());
    const auto found = std::find(words.begin(), words.end(), text);
    if (found == words.end()) Fail(node, path, WhatIs(node) + " is none of the choices; " + Offer(text, words));
    return static_cast<int>(found - words.begin());
  }

  /// Choices are few: all of them are said, the nearest first.
  static std::string Offer(const std::string& word, const std::vector<std::string>& words) {
    const std::string nearest = NearestWord(word, words);
    std::string text = nearest.empty() ? "choose one of " : "did you mean `" + nearest + "`? There are ";
    for (std::size_t i = 0; i < words.size(); ++i) text += (i == 0 ? "" : ", ") + words[i];
    return text;
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

  static int ElementIndex(const Node::Entry& entry, const std::string& path, std::size_t size) {
    const int index = ParseIndex(entry.key);
    if (index >= 0 && static_cast<std::size_t>(index) < size) return index;
    throw InputError(entry.key_where, JoinPath(path, entry.key),
                     size == 0 ? "the list is empty" : "the list has the elements 0 to " + std::to_string(size - 1));
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
               const Draw draw = DrawChoice(element, element_path);
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
               const Draw draw = DrawChoice(element, element_path);
               const std::size_t index = Alternative(*draw.node, draw.path, info, list.index(i), !patch);
               if (index != list.index(i)) list.emplace(i, index);
               Description description;
               list.describe(i, description);
               ReadStruct(*draw.node, draw.path, description, true);
             });
  }

  std::uint64_t seed_;
};

}  // namespace

void ReadDescribed(const YamlDocument& document, Description description, std::uint64_t seed) {
  Reader(seed).ReadStruct(document.root(), "", description);
}

}  // namespace alula::base
