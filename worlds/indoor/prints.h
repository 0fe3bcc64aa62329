#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "worlds/world.h"

namespace alula::worlds {

// Pictures that fill their texture once, u along x and v along y, from the stream "world/print/<name>" of the seed.
// Each adds a material named `name` and gives its index.

/// A play rug: streets with dashed middles about blocks of lawn, houses, ponds and car parks, on a pale rim.
int AddPlayRug(World& world, std::string_view name, int size, std::uint64_t seed);
/// Black tape with white scraps of random quadrangles, `aspect` times as long as wide; `size`
/// texels along it and a sixteenth across.
int AddSpeckTape(World& world, std::string_view name, int size, double aspect, std::uint64_t seed);
/// A calibration sheet of 6 × 6 square tags on white with corner squares between them (Kalibr's Aprilgrid; the codes
/// are random: nothing reads them).
int AddTagGrid(World& world, std::string_view name, int size, std::uint64_t seed);
/// A checkerboard of `columns` × `rows` on a white rim.
int AddCheckerboard(World& world, std::string_view name, int size, int columns, int rows);
/// Coarse cloth over foam: fine weave and slack folds that run across, brighter on one flank than on the other.
int AddQuilt(World& world, std::string_view name, int size, std::uint64_t seed);

/// A board of this size whose face towards `axis` (1: −y, 2: +z) shows the whole picture once; the other faces show the
/// colour of the picture's corner. X_WO: pose of its middle.
std::size_t AddPrintedBox(World& world, const std::string& name, const base::Vec3& size, const base::Transform& X_WO,
                          int axis, int material, SemanticClass semantic = SemanticClass::kObstacle);

}  // namespace alula::worlds
