#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

/// Who may include whom: the table of docs/architecture.md as code. It is the only one.
namespace alula::architecture {

/// A line that breaks a rule: "stack/a.h:3: includes geometry/mesh.h; stack may not".
struct Violation {
  std::string text;
};

/// Checks one file's includes. `path` is relative to the repository root, with slashes.
std::vector<Violation> CheckFile(const std::string& path, std::string_view text);

/// Checks every header and source of the rooms under `root`, in the order of their paths.
std::vector<Violation> CheckTree(const std::filesystem::path& root);

/// Number of files that CheckTree looks at.
std::size_t CountFiles(const std::filesystem::path& root);

}  // namespace alula::architecture
