#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "stack/slam/map.h"

namespace alula::stack::slam {

/// All parts of a map, whether they are joined or not: "ALULAMAP", u32 version, then eyes, anchors, keyframes and
/// landmarks as they stand in map.h; little-endian, doubles as they are. What was dropped is left out: ids are given
/// anew, without gaps, in the old order.
std::vector<std::uint8_t> ToBytes(const Map& map);

/// Throws base::InputError, with `name` in front, where the bytes are no map, one of another version, cut off, or name
/// keyframes or landmarks that are not there.
Map MapFromBytes(std::span<const std::uint8_t> bytes, const std::string& name);
/// Reads a file. Throws base::InputError where it is missing or broken.
Map LoadMap(const std::filesystem::path& file);

}  // namespace alula::stack::slam
