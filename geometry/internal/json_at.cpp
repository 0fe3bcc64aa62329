#include "geometry/internal/json_at.h"

#include <cmath>

#include "base/error.h"
#include "geometry/internal/file_bytes.h"

namespace alula::geometry::internal {
namespace {

using Json = nlohmann::json;

constexpr int kDeepest = 64;
constexpr int kMostValues = 1'000'000;

/// Counts brackets and commas outside strings before any value is made.
void CheckExtent(std::string_view text, const std::filesystem::path& file) {
  bool in_string = false;
  int depth = 0;
  int values = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\\' && in_string) {
      ++i;
    } else if (c == '"') {
      in_string = !in_string;
    } else if (!in_string) {
      if (c == '[' || c == '{') ++depth;
      if (c == ']' || c == '}') --depth;
      if (c == ',' || c == '[' || c == '{') ++values;
    }
    if (depth > kDeepest) FailIn(file, "its JSON is nested deeper than " + std::to_string(kDeepest) + " levels");
    if (values > kMostValues) FailIn(file, "its JSON has more than " + std::to_string(kMostValues) + " values");
  }
}

}  // namespace

Json ParseJson(std::string_view text, const std::filesystem::path& file) {
  CheckExtent(text, file);
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    FailIn(file, "is no JSON from byte " + std::to_string(error.byte) + " on; the file is broken or of another format");
  } catch (const Json::exception&) {  // a number beyond doubles
    FailIn(file, "its JSON holds a number that is out of range");
  }
}

void JsonAt::Fail(std::string_view what) const { throw base::InputError({file_->generic_string()}, path_, what); }

std::optional<JsonAt> JsonAt::Find(const char* key) const {
  if (!value_->is_object()) Fail("is no object");
  const auto found = value_->find(key);
  if (found == value_->end()) return std::nullopt;
  return JsonAt(*found, path_.empty() ? key : path_ + "." + key, *file_);
}

JsonAt JsonAt::Need(const char* key) const {
  if (const auto found = Find(key)) return *found;
  Fail("has no `" + std::string(key) + "`, which glTF 2.0 wants");
}

JsonAt JsonAt::Element(std::uint64_t index) const {
  if (index >= Size()) {
    Fail("has no element " + std::to_string(index) + ", which something refers to; there are " +
         std::to_string(Size()));
  }
  return JsonAt((*value_)[static_cast<std::size_t>(index)], path_ + "." + std::to_string(index), *file_);
}

std::size_t JsonAt::Size() const {
  if (!value_->is_array()) Fail("is no list");
  return value_->size();
}

std::uint64_t JsonAt::Natural() const {
  constexpr std::uint64_t kLargest = std::uint64_t{1} << 53U;
  if (!value_->is_number_unsigned() || value_->get<std::uint64_t>() > kLargest) Fail("is no whole number from 0 on");
  return value_->get<std::uint64_t>();
}

double JsonAt::Number() const {
  if (!value_->is_number() || !std::isfinite(value_->get<double>())) Fail("is no finite number");
  return value_->get<double>();
}

bool JsonAt::Truth() const {
  if (!value_->is_boolean()) Fail("is neither true nor false");
  return value_->get<bool>();
}

const std::string& JsonAt::Text() const {
  if (!value_->is_string()) Fail("is no text");
  return value_->get_ref<const std::string&>();
}

std::uint64_t JsonAt::NaturalOr(const char* key, std::uint64_t otherwise) const {
  const auto found = Find(key);
  return found ? found->Natural() : otherwise;
}

}  // namespace alula::geometry::internal
