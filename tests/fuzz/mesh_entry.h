#pragma once

#include <cstddef>
#include <cstdint>

namespace alula::fuzz {

/// Reads the bytes as a mesh file: GLB where they begin with its magic, glTF where they begin with a brace, OBJ
/// otherwise. Bad input may only end in InputError of one printable line; a mesh that is read must be one that the
/// renderer and Bullet can take: indices in range, finite, within bounds, unit normals, few enough triangles.
void ReadMesh(const std::uint8_t* data, std::size_t size);

}  // namespace alula::fuzz
