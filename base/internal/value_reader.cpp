#include "base/internal/value_reader.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/internal/quantity.h"
#include "base/nearest.h"

namespace alula::base::yaml_internal {

namespace {

constexpr const char* kNumberOrDistribution = "a number, {uniform: …}, {normal: …} or {choice: …}";

/// Runs a parser of quantity.h and adds file, line, column and key to what it has to say.
template <typename Function>
auto Located(const Node& node, const std::string& path, const Function& function) {
  try {
    return function();
  } catch (const InputError& error) {
    Fail(node, path, error.what());
  } catch (const FaultError& error) {
    throw FaultError(error.reason(), path + ": " + error.what());
  }
}

/// `uniform` over integers takes both ends with the same chance as all between.
double DrawInteger(double low, double high, RandomStream& stream) {
  if (high - low < 0x1p52) return low + static_cast<double>(stream.Index(static_cast<std::uint64_t>(high - low) + 1));
  return std::round(stream.Uniform(low, high));
}

/// P(x ≤ z) of the standard normal distribution.
double NormalShare(double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); }

/// The z below which the share u of a standard normal distribution lies: by bisection, which stops where doubles end.
double NormalQuantile(double u) {
  double low = -40.0, high = 40.0;
  for (double middle = 0.0; low < middle || middle < high; middle = 0.5 * (low + high)) {
    const bool below = NormalShare(middle) < u;
    if (middle == (below ? low : high)) break;
    (below ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// The u-quantile of a normal distribution that is cut off at both ends of a range.
double NormalQuantile(double u, double mean, double sigma, double min, double max) {
  if (sigma == 0.0) return mean;
  const double low = NormalShare((min - mean) / sigma);
  const double high = NormalShare((max - mean) / sigma);
  return std::clamp(mean + sigma * NormalQuantile(low + u * (high - low)), min, max);
}

std::string ExampleVec3(const FieldInfo& info) {
  return info.unit == "1" ? "[0, 0, 1]" : "[0, 0, 1] " + std::string(info.unit);
}

}  // namespace

void Fail(const Node& node, std::string_view path, const std::string& message) {
  throw InputError(node.where, path, message);
}

bool IsChoice(const Node& node) { return node.IsDistribution() && node.map[0].key == "choice"; }

ValueReader::Draw ValueReader::DrawChoice(const Node& node, const std::string& path) const {
  if (!IsChoice(node)) return {&node, path};
  const Node& choices = node.map[0].value;
  if (!choices.IsList() || choices.list.empty()) {
    Fail(choices, path, "`choice` wants a list of at least one value");
  }
  const std::optional<double> u = Quantile(path);
  const std::size_t drawn =
      u ? std::min(choices.list.size() - 1, static_cast<std::size_t>(*u * static_cast<double>(choices.list.size())))
        : static_cast<std::size_t>(RandomStream(seed_, "parameter/" + path).Index(choices.list.size()));
  const Node& chosen = choices.list[drawn];
  Note(path, {"choice", chosen.IsScalar() ? chosen.text : std::to_string(drawn), static_cast<double>(drawn)});
  return DrawChoice(choices.list[drawn], path + ".choice." + std::to_string(drawn));
}

const std::string& ScalarText(const Node& node, const std::string& path, const char* wanted) {
  if (node.IsNull()) Fail(node, path, std::string("has no value; ") + wanted + " is wanted");
  if (!node.IsScalar()) Fail(node, path, "is " + WhatIs(node) + "; " + wanted + " is wanted");
  return node.text;
}

std::optional<double> ValueReader::Quantile(const std::string& path) const {
  return draws_ != nullptr && draws_->quantile ? draws_->quantile(path) : std::nullopt;
}

void ValueReader::Note(const std::string& path, Drawn drawn) const {
  if (draws_ != nullptr) draws_->drawn.insert_or_assign(path, std::move(drawn));
}

/// Draws where `node` is a distribution, reads otherwise; either way within the field's range. `parse` gives a
/// number of the field's kind as a double; a drawn one of a `whole` field is a whole number.
template <typename Parse>
double ValueReader::NumberOrDraw(const Node& node, const std::string& path, const FieldInfo& info,
                                 std::string_view unit, const Parse& parse, bool whole) const {
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
  if (kind == "choice") {
    const Draw draw = DrawChoice(node, path);
    return NumberOrDraw(*draw.node, draw.path, info, unit, parse, whole);
  }
  if (!arguments.IsList() || arguments.list.size() != 2) {
    Fail(arguments, path,
         kind == "uniform" ? "`uniform` wants [lowest, highest]" : "`normal` wants [mean, standard deviation]");
  }
  const double first = read(arguments.list[0]);
  const double second = read(arguments.list[1]);
  checked(arguments.list[0], first);
  double value = 0.0;
  if (kind == "uniform") {
    if (first > second) Fail(arguments, path, "`uniform` wants the lowest value first");
    checked(arguments.list[1], second);
    value = DrawUniform(path, first, second, whole);
  } else {
    if (second < 0) Fail(arguments.list[1], path, "a standard deviation cannot be negative");
    const std::optional<double> drawn = DrawNormal(path, first, second, info, whole);
    if (!drawn) Fail(arguments, path, "almost never falls into its range; lower the standard deviation");
    value = *drawn;
  }
  Note(path, {kind, quantity::Format(value, unit), value});
  return value;
}

double ValueReader::DrawUniform(const std::string& path, double low, double high, bool whole) const {
  RandomStream stream(seed_, "parameter/" + path);
  const std::optional<double> u = Quantile(path);
  double value = 0.0;
  if (whole) {
    value = u ? low + std::floor(*u * (high - low + 1.0)) : DrawInteger(low, high, stream);
  } else {
    value = u ? low + *u * (high - low) : stream.Uniform(low, high);
  }
  return std::clamp(value, low, high);
}

std::optional<double> ValueReader::DrawNormal(const std::string& path, double mean, double sigma, const FieldInfo& info,
                                              bool whole) const {
  const auto rounded = [whole](double value) { return whole ? std::round(value) : value; };
  if (const std::optional<double> u = Quantile(path)) {
    return rounded(NormalQuantile(*u, mean, sigma, info.min, info.max));
  }
  RandomStream stream(seed_, "parameter/" + path);
  constexpr int kMostDraws = 1000;  // the mean lies in the range, so half of the draws do on one side at least
  for (int i = 0; i < kMostDraws; ++i) {
    const double value = rounded(mean + sigma * stream.Gaussian());
    if (value >= info.min && value <= info.max) return value;
  }
  return std::nullopt;
}

double ValueReader::ReadDouble(const Node& node, const std::string& path, const FieldInfo& info,
                               bool may_be_infinite) const {
  return NumberOrDraw(
      node, path, info, info.unit,
      [&](const std::string& text) { return quantity::ParseNumber(text, info.unit, may_be_infinite); }, false);
}

template <typename Integer>
Integer ValueReader::ReadInteger(const Node& node, const std::string& path, const FieldInfo& info) const {
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
  limits.min = std::max(limits.min, -0x1p53);  // draws go through a double
  limits.max = std::min(limits.max, 0x1p53);
  return static_cast<Integer>(NumberOrDraw(
      node, path, limits, info.unit, [&](const std::string& text) { return static_cast<double>(parse(text)); }, true));
}

void ValueReader::Read(double* value, const FieldInfo& info, const Node& node, const std::string& path) const {
  *value = ReadDouble(node, path, info, std::isinf(*value));
}
void ValueReader::Read(int* value, const FieldInfo& info, const Node& node, const std::string& path) const {
  *value = ReadInteger<int>(node, path, info);
}
void ValueReader::Read(std::int64_t* value, const FieldInfo& info, const Node& node, const std::string& path) const {
  *value = ReadInteger<std::int64_t>(node, path, info);
}
void ValueReader::Read(std::uint64_t* value, const FieldInfo& info, const Node& node, const std::string& path) const {
  *value = ReadInteger<std::uint64_t>(node, path, info);
}
void ValueReader::Read(bool* value, const FieldInfo&, const Node& node, const std::string& path) const {
  const std::string& text = ScalarText(node, path, "true or false");
  if (text != "true" && text != "false") Fail(node, path, WhatIs(node) + " is neither `true` nor `false`");
  *value = text == "true";
}
void ValueReader::Read(std::string* value, const FieldInfo& info, const Node& node, const std::string& path) const {
  const std::string& text = ScalarText(node, path, "a text");
  if (!info.choices.empty()) ChoiceIndex(node, path, info);
  *value = text;
  if (!info.is_path || text.empty() || std::filesystem::path(text).is_absolute()) return;
  const std::filesystem::path folder =
      node.where.line > 0 ? std::filesystem::path(node.where.file).parent_path() : std::filesystem::path();
  *value = std::filesystem::absolute(folder / text).lexically_normal().string();
}
void ValueReader::Read(Duration* value, const FieldInfo& info, const Node& node, const std::string& path) const {
  const double seconds = NumberOrDraw(
      node, path, info, "s", [](const std::string& text) { return quantity::ParseDuration(text).Seconds(); }, false);
  *value = node.IsScalar() ? quantity::ParseDuration(node.text) : Seconds(seconds);
}
void ValueReader::Read(Rate* value, const FieldInfo& info, const Node& node, const std::string& path) const {
  const std::string& text = ScalarText(node, path, "a frequency");
  const Rate rate = Located(node, path, [&] { return quantity::ParseRate(text); });
  Located(node, path, [&] { quantity::CheckRange(rate.Hz(), info, "Hz", text); });
  *value = rate;
}
void ValueReader::Read(Vec3* value, const FieldInfo& info, const Node& node, const std::string& path) const {
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
int ChoiceIndex(const Node& node, const std::string& path, const FieldInfo& info) {
  const std::string& text = ScalarText(node, path, "a word");
  const std::vector<std::string> words(info.choices.begin(), info.choices.end());
  const auto found = std::find(words.begin(), words.end(), text);
  if (found == words.end()) Fail(node, path, WhatIs(node) + " is none of the choices; " + Offer(text, words));
  return static_cast<int>(found - words.begin());
}

// Choices are few: all of them are said, the nearest first.
std::string Offer(const std::string& word, const std::vector<std::string>& words) {
  const std::string nearest = NearestWord(word, words);
  std::string text = nearest.empty() ? "choose one of " : "did you mean `" + nearest + "`? There are ";
  for (std::size_t i = 0; i < words.size(); ++i) text += (i == 0 ? "" : ", ") + words[i];
  return text;
}

void ValueReader::PatchVec3(Vec3* value, const FieldInfo& info, const Node& node, const std::string& path) const {
  for (const Node::Entry& entry : node.map) {
    const int index = ElementIndex(entry, path, 3);
    (*value)[index] = ReadDouble(entry.value, JoinPath(path, entry.key), info, false);
  }
}

/// {uniform: [[…], […]]} draws each component by itself.
void ValueReader::DrawVec3(Vec3* value, const FieldInfo& info, const Node& node, const std::string& path) const {
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

int ElementIndex(const Node::Entry& entry, const std::string& path, std::size_t size) {
  const int index = ParseIndex(entry.key);
  if (index >= 0 && static_cast<std::size_t>(index) < size) return index;
  throw InputError(entry.key_where, JoinPath(path, entry.key),
                   size == 0 ? "the list is empty" : "the list has the elements 0 to " + std::to_string(size - 1));
}

}  // namespace alula::base::yaml_internal
