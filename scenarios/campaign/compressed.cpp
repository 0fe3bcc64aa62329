#include "scenarios/campaign/internal/compressed.h"

#include <zlib.h>

#include <cstdint>
#include <cstring>

#include "base/error.h"

namespace alula::scenarios::campaign::internal {

std::string Compressed(std::string_view text) {
  uLongf size = ::compressBound(text.size());
  std::string bytes(sizeof(std::uint64_t) + size, '\0');
  const std::uint64_t length = text.size();
  std::memcpy(bytes.data(), &length, sizeof length);
  const int result = ::compress2(reinterpret_cast<Bytef*>(bytes.data() + sizeof length), &size,
                                 reinterpret_cast<const Bytef*>(text.data()), text.size(), Z_DEFAULT_COMPRESSION);
  if (result != Z_OK) throw base::FaultError("database", "a text could not be compressed");
  bytes.resize(sizeof length + size);
  return bytes;
}

std::string Expanded(std::string_view bytes) {
  constexpr std::uint64_t kMost = 1U << 30;  // no text of ours is longer
  std::uint64_t length = 0;
  if (bytes.size() >= sizeof length) std::memcpy(&length, bytes.data(), sizeof length);
  std::string text(length <= kMost ? length : 0, '\0');
  uLongf size = text.size();
  if (bytes.size() < sizeof length || length > kMost ||
      ::uncompress(reinterpret_cast<Bytef*>(text.data()), &size,
                   reinterpret_cast<const Bytef*>(bytes.data() + sizeof length),
                   bytes.size() - sizeof length) != Z_OK ||
      size != length) {
    throw base::FaultError("database", "a text of the database is damaged");
  }
  return text;
}

}  // namespace alula::scenarios::campaign::internal
