#pragma once

#include <filesystem>
#include <string_view>

namespace alula::worlds {

/// Where a mesh of this room lies: <source tree>/worlds/assets/<name>. Whether it is there, the loader says.
std::filesystem::path AssetPath(std::string_view name);

/// <source tree>/worlds/catalog.
std::filesystem::path CatalogPath();

}  // namespace alula::worlds
