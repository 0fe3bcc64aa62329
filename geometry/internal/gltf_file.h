#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "geometry/internal/json_at.h"

namespace alula::geometry::internal {

/// All buffers of one file together; a mesh of 200 000 triangles takes about 20 MB.
inline constexpr std::size_t kMostBufferBytes = 128UL << 20U;

/// The JSON of a .gltf or .glb file and the bytes of its buffers, which are read when first asked for: the GLB's own
/// chunk, base64 in a data URI, or a file in the mesh's folder or below it (never outside, links followed).
class GltfFile {
 public:
  /// `file` names the text in messages; its folder holds the buffers. Throws base::InputError.
  GltfFile(std::string_view bytes, bool is_glb, const std::filesystem::path& file);

  JsonAt root() const { return {json_, "", file_}; }
  const std::filesystem::path& file() const { return file_; }

  /// The `byteLength` bytes of buffer `index`.
  std::string_view Buffer(std::uint64_t index);

 private:
  std::string ReadBuffer(const JsonAt& buffer, std::uint64_t index, std::size_t room) const;

  std::filesystem::path file_;
  nlohmann::json json_;
  std::string_view chunk_;  // of a GLB
  std::map<std::uint64_t, std::string> buffers_;
  std::size_t buffer_bytes_ = 0;
};

}  // namespace alula::geometry::internal
