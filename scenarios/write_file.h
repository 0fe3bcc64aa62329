#pragma once

#include <filesystem>
#include <string_view>

namespace alula::scenarios {

/// Writes a whole file that somebody asked for by `option` ("--json"), or none: under a temporary name first. "-" is
/// the standard output. Throws base::InputError.
void WriteFile(std::string_view option, const std::filesystem::path& file, std::string_view text);

}  // namespace alula::scenarios
