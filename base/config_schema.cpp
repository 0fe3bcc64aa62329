#include <cmath>
#include <type_traits>

#include "base/config.h"
#include "base/error.h"
#include "base/internal/quantity.h"

namespace alula::base {

namespace {

using Bound = Description::Bound;

std::string Json(std::string_view text) {
  std::string json = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') json += '\\';
    json += c == '\n' || c == '\t' ? ' ' : c;
  }
  return json + "\"";
}

std::string Join(const std::vector<std::string>& parts) {
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i) text += (i == 0 ? "" : ",") + parts[i];
  return text;
}

std::string Words(const FieldInfo& info) {
  std::vector<std::string> words;
  for (const std::string_view word : info.choices) words.push_back(Json(word));
  return "\"enum\":[" + Join(words) + "]";
}

std::string Described(const FieldInfo& info, std::string_view unit) {
  std::string text(info.meaning);
  if (unit != "1") text += " [" + std::string(unit) + "]";
  if (std::isfinite(info.min)) text += ", at least " + quantity::Format(info.min, unit);
  if (std::isfinite(info.max)) text += ", at most " + quantity::Format(info.max, unit);
  return text.empty() ? "" : ",\"description\":" + Json(text);
}

/// A number with a unit is a text to YAML; a pure one may be a plain number. Either may be a distribution.
std::string Quantity(std::string_view unit, std::string_view plain) {
  const std::string number = unit == "1" ? "{\"type\":\"" + std::string(plain) + "\"}," : "";
  return "\"anyOf\":[" + number + "{\"type\":\"string\"},{\"$ref\":\"#/$defs/distribution\"}]";
}

std::string ValueSchema(const double*, const FieldInfo& info) { return Quantity(info.unit, "number"); }
std::string ValueSchema(const int*, const FieldInfo& info) { return Quantity(info.unit, "integer"); }
std::string ValueSchema(const std::int64_t*, const FieldInfo& info) { return Quantity(info.unit, "integer"); }
std::string ValueSchema(const std::uint64_t*, const FieldInfo& info) { return Quantity(info.unit, "integer"); }
std::string ValueSchema(const bool*, const FieldInfo&) {
  return "\"anyOf\":[{\"type\":\"boolean\"},{\"$ref\":\"#/$defs/distribution\"}]";
}
std::string ValueSchema(const std::string*, const FieldInfo& info) {
  if (!info.choices.empty()) return Words(info);
  return "\"anyOf\":[{\"type\":\"string\"},{\"$ref\":\"#/$defs/distribution\"}]";
}
std::string ValueSchema(const Duration*, const FieldInfo&) { return Quantity("s", "number"); }
std::string ValueSchema(const Rate*, const FieldInfo&) { return Quantity("Hz", "number"); }
std::string ValueSchema(const Vec3*, const FieldInfo& info) {
  return "\"anyOf\":[{\"type\":\"array\",\"minItems\":3,\"maxItems\":3,\"items\":{" + Quantity(info.unit, "number") +
         "}},{\"$ref\":\"#/$defs/distribution\"}]";
}
template <typename T>
std::string ValueSchema(const std::vector<T>*, const FieldInfo& info) {
  return "\"type\":\"array\",\"items\":{" + ValueSchema(static_cast<const T*>(nullptr), info) + "}";
}

std::string_view UnitOf(const Bound::Scalar& scalar, const FieldInfo& info) {
  if (std::holds_alternative<Duration*>(scalar)) return "s";
  return std::holds_alternative<Rate*>(scalar) ? std::string_view("Hz") : info.unit;
}

std::string Inside(const Bound& field);

/// The inside of a JSON object that describes a struct; `type` is the alternative's word, if it is one.
std::string StructSchema(const Description& description, std::string_view type = "") {
  if (description.fields().size() == 1 && description.fields()[0].name.empty()) return Inside(description.fields()[0]);
  std::vector<std::string> properties = {"\"extends\":{\"type\":\"string\"}"};
  if (!type.empty()) properties.push_back("\"type\":{\"const\":" + Json(type) + "}");
  for (const Bound& field : description.fields()) {
    properties.push_back(Json(field.name) + ":{" + Inside(field) + "}");
  }
  return "\"type\":\"object\",\"additionalProperties\":false,\"properties\":{" + Join(properties) + "}";
}

/// Walks the alternatives and leaves the variant at the one that it held (with that one's defaults).
template <typename Emplace, typename DescribeOne>
std::string Alternatives(const FieldInfo& info, std::size_t current, const Emplace& emplace,
                         const DescribeOne& describe) {
  std::vector<std::string> schemas;
  for (std::size_t i = 0; i < info.choices.size(); ++i) {
    emplace(i);
    Description description;
    describe(description);
    schemas.push_back("{" + StructSchema(description, info.choices[i]) + "}");
  }
  emplace(current);
  return "\"anyOf\":[" + Join(schemas) + "]";
}

std::string Schema(const Bound::Scalar& scalar, const FieldInfo& info) {
  return std::visit([&](const auto* value) { return ValueSchema(value, info); }, scalar);
}
std::string Schema(const Bound::Enum&, const FieldInfo& info) { return Words(info); }
std::string Schema(const Bound::Struct& value, const FieldInfo&) {
  Description description;
  value.describe(description);
  return StructSchema(description);
}
std::string Schema(const Bound::Optional& value, const FieldInfo&) {
  const bool present = value.present();
  if (!present) value.emplace(true);
  Description description;
  value.describe(description);
  const std::string schema = StructSchema(description);
  if (!present) value.emplace(false);
  return "\"anyOf\":[{\"type\":\"null\"},{" + schema + "}]";
}
std::string Schema(const Bound::OneOf& value, const FieldInfo& info) {
  return Alternatives(info, value.index(), value.emplace, value.describe);
}
std::string Schema(const Bound::List& list, const FieldInfo&) {
  const std::size_t size = list.size();
  list.resize(size + 1);  // an element to describe, also where the default list is empty
  Description description;
  list.describe(size, description);
  const std::string schema = StructSchema(description);
  list.resize(size);
  return "\"type\":\"array\",\"items\":{" + schema + "}";
}
std::string Schema(const Bound::ListOfOneOf& list, const FieldInfo& info) {
  const std::size_t size = list.size();
  list.resize(size + 1);
  const std::string schema = Alternatives(
      info, 0, [&](std::size_t i) { list.emplace(size, i); }, [&](Description& d) { list.describe(size, d); });
  list.resize(size);
  return "\"type\":\"array\",\"items\":{" + schema + "}";
}

std::string Inside(const Bound& field) {
  const auto* scalar = std::get_if<Bound::Scalar>(&field.value);
  const std::string_view unit = scalar != nullptr ? UnitOf(*scalar, field.info) : field.info.unit;
  return std::visit([&](const auto& value) { return Schema(value, field.info); }, field.value) +
         Described(field.info, unit);
}

}  // namespace

std::string SchemaOf(const Description& description, std::string_view title) {
  return "{\"$schema\":\"https://json-schema.org/draft/2020-12/schema\",\"title\":" + Json(title) +
         ",\"$defs\":{\"distribution\":{\"type\":\"object\",\"minProperties\":1,\"maxProperties\":1,"
         "\"additionalProperties\":false,\"properties\":{\"uniform\":{\"type\":\"array\"},"
         "\"normal\":{\"type\":\"array\"},\"choice\":{\"type\":\"array\"}}}}," +
         StructSchema(description) + "}\n";
}

}  // namespace alula::base
