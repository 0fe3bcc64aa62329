#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace alula::geometry::internal {

/// JSON from outside: at most 64 levels deep and a million values, so that it costs no more memory than its text
/// foretells. Throws base::InputError.
nlohmann::json ParseJson(std::string_view text, const std::filesystem::path& file);

/// A value in a JSON file and the way to it ("nodes.3.mesh"), for messages. All that reads it checks its kind and
/// throws base::InputError.
class JsonAt {
 public:
  JsonAt(const nlohmann::json& value, std::string path, const std::filesystem::path& file)
      : value_(&value), path_(std::move(path)), file_(&file) {}

  [[noreturn]] void Fail(std::string_view what) const;

  /// A member of an object; none where it is absent.
  std::optional<JsonAt> Find(const char* key) const;
  /// A member that must be there.
  JsonAt Need(const char* key) const;
  /// Element of an array; an error where there is none.
  JsonAt Element(std::uint64_t index) const;
  /// Number of elements of an array.
  std::size_t Size() const;

  /// A whole number from 0 to 2^53.
  std::uint64_t Natural() const;
  double Number() const;
  bool Truth() const;
  const std::string& Text() const;
  /// Member `key` as Natural(), or `otherwise` where it is absent.
  std::uint64_t NaturalOr(const char* key, std::uint64_t otherwise) const;

 private:
  const nlohmann::json* value_;
  std::string path_;
  const std::filesystem::path* file_;
};

}  // namespace alula::geometry::internal
