#include "worlds/assets.h"

namespace alula::worlds {

std::filesystem::path AssetPath(std::string_view name) {
  return std::filesystem::path(ALULA_SOURCE_DIR) / "worlds" / "assets" / name;
}

std::filesystem::path CatalogPath() { return std::filesystem::path(ALULA_SOURCE_DIR) / "worlds" / "catalog"; }

}  // namespace alula::worlds
