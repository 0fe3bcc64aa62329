#include "geometry/internal/gltf_accessor.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <string>

namespace alula::geometry::internal {
namespace {

// Component types as glTF numbers them.
constexpr std::uint64_t kByte = 5120;
constexpr std::uint64_t kUnsignedByte = 5121;
constexpr std::uint64_t kShort = 5122;
constexpr std::uint64_t kUnsignedShort = 5123;
constexpr std::uint64_t kUnsignedInt = 5125;
constexpr std::uint64_t kFloat = 5126;

std::uint64_t SizeOf(std::uint64_t type) {
  if (type == kByte || type == kUnsignedByte) return 1;
  if (type == kShort || type == kUnsignedShort) return 2;
  return type == kUnsignedInt || type == kFloat ? 4 : 0;
}

template <typename T>
T Copied(std::string_view bytes, std::uint64_t at) {
  T value{};
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

/// A whole number as it stands, or as a share of the largest of its type (glTF 2.0, section 3.6.2.2).
template <typename T>
double Whole(std::string_view bytes, std::uint64_t at, bool normalised) {
  const double value = static_cast<double>(Copied<T>(bytes, at));
  return normalised ? std::max(value / static_cast<double>(std::numeric_limits<T>::max()), -1.0) : value;
}

}  // namespace

GltfAccessor::GltfAccessor(GltfFile& file, std::uint64_t index, int components) {
  const JsonAt accessor = file.root().Need("accessors").Element(index);
  const std::string wanted = components == 1 ? "SCALAR" : "VEC" + std::to_string(components);
  if (accessor.Need("type").Text() != wanted) accessor.Fail("should be of type " + wanted);
  if (accessor.Find("sparse")) accessor.Fail("is sparse, which is not read; export without sparse accessors");
  type_ = accessor.Need("componentType").Natural();
  const std::uint64_t element = SizeOf(type_) * static_cast<std::uint64_t>(components);
  if (element == 0) accessor.Fail("has no component type of glTF 2.0");
  const auto normalised = accessor.Find("normalized");
  normalised_ = normalised && normalised->Truth();
  count_ = accessor.Need("count").Natural();
  if (count_ == 0) accessor.Fail("has no elements");

  const JsonAt view = file.root().Need("bufferViews").Element(accessor.Need("bufferView").Natural());
  const std::string_view buffer = file.Buffer(view.Need("buffer").Natural());
  const std::uint64_t view_at = view.NaturalOr("byteOffset", 0);
  const std::uint64_t view_length = view.Need("byteLength").Natural();
  if (view_at > buffer.size() || view_length > buffer.size() - view_at) view.Fail("reaches beyond its buffer");
  stride_ = view.NaturalOr("byteStride", element);
  if (stride_ < element || stride_ > 252) view.Fail("has a byteStride that glTF 2.0 does not allow");
  const std::uint64_t at = accessor.NaturalOr("byteOffset", 0);
  // In this order nothing overflows: `count − 1` elements of `stride` bytes and one of `element` must fit.
  if (at > view_length || view_length - at < element || (view_length - at - element) / stride_ < count_ - 1) {
    accessor.Fail("reaches beyond its buffer view");
  }
  bytes_ = buffer.substr(view_at + at, view_length - at);
}

bool GltfAccessor::IsIndex() const {
  return type_ == kUnsignedByte || type_ == kUnsignedShort || type_ == kUnsignedInt;
}

double GltfAccessor::At(std::uint64_t element, int component) const {
  const std::uint64_t at = element * stride_ + static_cast<std::uint64_t>(component) * SizeOf(type_);
  switch (type_) {
    case kByte:
      return Whole<std::int8_t>(bytes_, at, normalised_);
    case kUnsignedByte:
      return Whole<std::uint8_t>(bytes_, at, normalised_);
    case kShort:
      return Whole<std::int16_t>(bytes_, at, normalised_);
    case kUnsignedShort:
      return Whole<std::uint16_t>(bytes_, at, normalised_);
    case kUnsignedInt:
      return Whole<std::uint32_t>(bytes_, at, normalised_);
    default:
      return static_cast<double>(Copied<float>(bytes_, at));
  }
}

std::uint32_t GltfAccessor::Index(std::uint64_t element) const {
  const std::uint64_t at = element * stride_;
  if (type_ == kUnsignedByte) return Copied<std::uint8_t>(bytes_, at);
  return type_ == kUnsignedShort ? Copied<std::uint16_t>(bytes_, at) : Copied<std::uint32_t>(bytes_, at);
}

}  // namespace alula::geometry::internal
