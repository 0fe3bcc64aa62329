#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace alula::geometry::internal {

/// Throws base::InputError "<file>: <what>".
[[noreturn]] void FailIn(const std::filesystem::path& file, std::string_view what);

/// All of a regular, non-empty file of at most `max_bytes`. `kind` ("mesh", "texture", "buffer") names it in messages.
/// A pipe, a device or a folder is refused without waiting for it. Throws base::InputError.
std::string ReadWhole(const std::filesystem::path& file, std::string_view kind, std::size_t max_bytes);

/// ".OBJ" → ".obj".
std::string LowerExtension(const std::filesystem::path& file);

/// Text of a file as it may stand in a message: at most 40 bytes, whatever is not printable ASCII as '?'.
std::string Shown(std::string_view text);

}  // namespace alula::geometry::internal
