#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <istream>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/time.h"

namespace alula::base {

/// One row of a table in a text file: cells apart by commas or, in a row without commas, by blanks. Every reader of a
/// cell throws InputError with file and line; `name` is the column's, for the message.
class TextRow {
 public:
  TextRow(std::string_view line, SourcePosition where);

  std::size_t size() const { return cells_.size(); }
  bool has_commas() const { return has_commas_; }
  const SourcePosition& where() const { return where_; }

  /// Blanks around it removed; may be empty.
  std::string_view Word(std::size_t i, std::string_view name) const;
  /// A finite number; neither locale nor length changes what is read.
  double Number(std::size_t i, std::string_view name) const;
  /// A time in whole nanoseconds ("1403715273262142976").
  Time TimeInNanoseconds(std::size_t i, std::string_view name) const;
  /// A time in decimal seconds ("1305031102.175304"), exact to the nanosecond, which a double would not be.
  Time TimeInSeconds(std::size_t i, std::string_view name) const;
  [[noreturn]] void Fail(std::string_view name, const std::string& message) const;

 private:
  std::vector<std::string_view> cells_;  // into the line that it was made from
  SourcePosition where_;
  bool has_commas_ = false;
};

/// Calls `take` for every row that is neither empty nor a comment ('#' first). A row is valid during the call only.
void ForEachRow(std::istream& text, const std::string& file_name, const std::function<void(const TextRow&)>& take);
/// Throws InputError where the file cannot be read.
std::ifstream OpenText(const std::filesystem::path& file);
/// ForEachRow of a file.
void ForEachRowOf(const std::filesystem::path& file, const std::function<void(const TextRow&)>& take);

}  // namespace alula::base
