#include <cmath>

#include "base/config.h"
#include "base/error.h"
#include "base/internal/quantity.h"

namespace alula::base {

namespace {

using Bound = Description::Bound;

std::string Quoted(const std::string& text) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./-";
  const bool plain = !text.empty() && text.find_first_not_of(kPlain) == std::string::npos && std::isalpha(text[0]) &&
                     text != "null" && text != "Null" && text != "NULL";
  if (plain) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      quoted += '\\';
      quoted += c;
    } else if (c == '\n') {
      quoted += "\\n";
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      constexpr std::string_view kHex = "0123456789abcdef";
      quoted += "\\x";
      quoted += kHex[static_cast<std::size_t>(c) >> 4];
      quoted += kHex[static_cast<std::size_t>(c) & 15];
    } else {
      quoted += c;
    }
  }
  return quoted + "\"";
}

std::string Value(double value, const FieldInfo& info) {
  if (std::isnan(value)) throw FaultError("bad_description", "a field holds NaN and cannot be written");
  return quantity::Format(value, info.unit);
}
template <typename Integer>
std::string IntegerValue(Integer value, const FieldInfo& info) {
  return std::to_string(value) + (info.unit == "1" ? "" : " " + std::string(info.unit));
}
std::string Value(int value, const FieldInfo& info) { return IntegerValue(value, info); }
std::string Value(std::int64_t value, const FieldInfo& info) { return IntegerValue(value, info); }
std::string Value(std::uint64_t value, const FieldInfo& info) { return IntegerValue(value, info); }
std::string Value(bool value, const FieldInfo&) { return value ? "true" : "false"; }
std::string Value(const std::string& value, const FieldInfo&) { return Quoted(value); }
std::string Value(const Vec3& value, const FieldInfo& info) {
  return "[" + Value(value.x(), info) + ", " + Value(value.y(), info) + ", " + Value(value.z(), info) + "]";
}
std::string Value(Duration value, const FieldInfo&) { return quantity::Format(value); }
std::string Value(Rate value, const FieldInfo&) { return quantity::Format(value); }
template <typename T>
std::string Value(const std::vector<T>& values, const FieldInfo& info) {
  std::string text = "[";
  for (std::size_t i = 0; i < values.size(); ++i) text += (i == 0 ? "" : ", ") + Value(values[i], info);
  return text + "]";
}

std::string_view Word(const FieldInfo& info, std::size_t index, const std::string& name) {
  if (index < info.choices.size()) return info.choices[index];
  throw FaultError("bad_description", name + ": value " + std::to_string(index) + " has no word among its choices");
}

class Dumper {
 public:
  /// The fields of a struct as lines, each indented by `indent`.
  std::string Fields(const Description& description, std::size_t indent) const {
    std::string text;
    for (const Bound& field : description.fields()) text += Field(field, indent);
    return text;
  }

 private:
  static std::string Line(const Bound& field, std::size_t indent, const std::string& value) {
    return std::string(indent, ' ') + field.name + ": " + value + "\n";
  }

  std::string Field(const Bound& field, std::size_t indent) const {
    return std::visit([&](const auto& value) { return Text(value, field, indent); }, field.value);
  }

  std::string Text(const Bound::Scalar& scalar, const Bound& field, std::size_t indent) const {
    return Line(field, indent, std::visit([&](const auto* value) { return Value(*value, field.info); }, scalar));
  }
  std::string Text(const Bound::Enum& value, const Bound& field, std::size_t indent) const {
    return Line(field, indent, std::string(Word(field.info, static_cast<std::size_t>(value.get()), field.name)));
  }
  std::string Text(const Bound::Struct& value, const Bound& field, std::size_t indent) const {
    Description description;
    value.describe(description);
    return Block(field, indent, "", description);
  }
  std::string Text(const Bound::Optional& value, const Bound& field, std::size_t indent) const {
    if (!value.present()) return Line(field, indent, "null");
    Description description;
    value.describe(description);
    return Block(field, indent, "", description);
  }
  std::string Text(const Bound::OneOf& value, const Bound& field, std::size_t indent) const {
    Description description;
    value.describe(description);
    return Block(field, indent, Word(field.info, value.index(), field.name), description);
  }
  std::string Text(const Bound::List& list, const Bound& field, std::size_t indent) const {
    return List(field, indent, list.size(), list.describe, [](std::size_t) { return std::string_view(); });
  }
  std::string Text(const Bound::ListOfOneOf& list, const Bound& field, std::size_t indent) const {
    return List(field, indent, list.size(), list.describe,
                [&](std::size_t i) { return Word(field.info, list.index(i), field.name); });
  }

  /// One unnamed field is a value by itself (an element that is no struct).
  static bool IsOneValue(const Description& description) {
    return description.fields().size() == 1 && description.fields()[0].name.empty();
  }

  std::string Body(std::string_view type, const Description& description, std::size_t indent) const {
    std::string text;
    if (!type.empty()) text = std::string(indent, ' ') + "type: " + std::string(type) + "\n";
    return text + Fields(description, indent);
  }

  std::string Block(const Bound& field, std::size_t indent, std::string_view type,
                    const Description& description) const {
    if (IsOneValue(description)) {
      Bound named = description.fields()[0];
      named.name = field.name;
      return Field(named, indent);
    }
    const std::string body = Body(type, description, indent + 2);
    if (body.empty()) return Line(field, indent, "{}");
    return std::string(indent, ' ') + field.name + ":\n" + body;
  }

  template <typename DescribeOne, typename TypeOf>
  std::string List(const Bound& field, std::size_t indent, std::size_t size, const DescribeOne& describe,
                   const TypeOf& type_of) const {
    if (size == 0) return Line(field, indent, "[]");
    std::string text = std::string(indent, ' ') + field.name + ":\n";
    for (std::size_t i = 0; i < size; ++i) {
      Description description;
      describe(i, description);
      std::string body = Body(type_of(i), description, indent + 4);
      if (IsOneValue(description)) body.erase(indent + 4, 2);  // the ": " of a field without a name
      if (body.empty()) body = std::string(indent + 4, ' ') + "{}\n";
      body[indent + 2] = '-';
      text += body;
    }
    return text;
  }
};

}  // namespace

std::string DumpDescribed(const Description& description) { return Dumper().Fields(description, 0); }

}  // namespace alula::base
