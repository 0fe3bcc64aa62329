#pragma once

#include <cstdint>
#include <string_view>

#include "geometry/internal/gltf_file.h"

namespace alula::geometry::internal {

/// The numbers that an accessor names (glTF 2.0, section 3.6.2); all of them lie inside its buffer view.
class GltfAccessor {
 public:
  /// `components` numbers an element are wanted (3: "VEC3"). Throws base::InputError.
  GltfAccessor(GltfFile& file, std::uint64_t index, int components);

  std::uint64_t count() const { return count_; }
  /// Whether its elements are whole numbers from 0 on, as indices are.
  bool IsIndex() const;
  /// Component of an element; element < count(). Normalised whole numbers come as [0, 1] or [−1, 1].
  double At(std::uint64_t element, int component) const;
  std::uint32_t Index(std::uint64_t element) const;

 private:
  std::string_view bytes_;  // from the first element on
  std::uint64_t count_ = 0;
  std::uint64_t stride_ = 0;
  std::uint64_t type_ = 0;  // a GL number
  bool normalised_ = false;
};

}  // namespace alula::geometry::internal
