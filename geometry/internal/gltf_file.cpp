#include "geometry/internal/gltf_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <optional>

#include "geometry/internal/file_bytes.h"

namespace alula::geometry::internal {
namespace {

namespace fs = std::filesystem;

static_assert(std::endian::native == std::endian::little, "glTF is little-endian and is copied as it stands");

std::uint32_t Word(std::string_view bytes, std::size_t at) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + at, sizeof word);
  return word;
}

struct Chunks {
  std::string_view json;
  std::string_view binary;
};

/// glTF 2.0, section 4.4: a header of magic, version and length, then chunks of length, type and bytes.
Chunks SplitGlb(std::string_view bytes, const fs::path& file) {
  constexpr std::uint32_t kMagic = 0x46546C67;   // "glTF"
  constexpr std::uint32_t kJson = 0x4E4F534A;    // "JSON"
  constexpr std::uint32_t kBinary = 0x004E4942;  // "BIN"
  if (bytes.size() < 20 || Word(bytes, 0) != kMagic) FailIn(file, "is no GLB file");
  if (Word(bytes, 4) != 2) FailIn(file, "is GLB of version " + std::to_string(Word(bytes, 4)) + "; export glTF 2.0");
  if (Word(bytes, 8) > bytes.size()) FailIn(file, "is cut off: its header tells of more bytes than there are");
  bytes = bytes.substr(0, Word(bytes, 8));
  Chunks chunks;
  for (std::size_t at = 12; at + 8 <= bytes.size();) {
    const std::size_t length = Word(bytes, at);
    const std::uint32_t type = Word(bytes, at + 4);
    at += 8;
    if (length > bytes.size() - at) FailIn(file, "is cut off: a chunk is longer than the file");
    if (type == kJson && chunks.json.empty()) chunks.json = bytes.substr(at, length);
    if (type == kBinary && chunks.binary.empty()) chunks.binary = bytes.substr(at, length);
    at += length;
  }
  if (chunks.json.empty()) FailIn(file, "has no JSON chunk; the file is broken");
  return chunks;
}

/// RFC 4648, section 4; none where a character does not belong.
std::optional<std::string> DecodeBase64(std::string_view text) {
  static constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::array<int, 256> value{};
  value.fill(-1);
  for (std::size_t i = 0; i < kDigits.size(); ++i) value[static_cast<unsigned char>(kDigits[i])] = static_cast<int>(i);
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3 + 2);
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    const int digit = value[static_cast<unsigned char>(c)];
    if (digit < 0) return std::nullopt;
    bits = ((bits << 6U) | static_cast<std::uint32_t>(digit)) & 0xffffffU;
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>((bits >> static_cast<unsigned>(count)) & 0xffU);
  }
  return bytes;
}

/// RFC 3986, section 2.1; none where the digits are missing.
std::optional<std::string> DecodePercent(std::string_view uri) {
  const auto digit = [](char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
  };
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] != '%') {
      text += uri[i];
      continue;
    }
    if (i + 2 >= uri.size() || digit(uri[i + 1]) < 0 || digit(uri[i + 2]) < 0) return std::nullopt;
    text += static_cast<char>(16 * digit(uri[i + 1]) + digit(uri[i + 2]));
    i += 2;
  }
  return text;
}

/// The file that a relative URI names, if it lies in `folder` or below it once links are followed.
std::optional<fs::path> Below(const fs::path& folder, std::string_view uri) {
  constexpr std::size_t kLongestName = 255;
  const std::optional<std::string> name = DecodePercent(uri);
  if (!name || name->empty() || name->size() > kLongestName) return {};
  if (std::any_of(name->begin(), name->end(), [](unsigned char c) {
        return c == '\\' || c == ':' || c < 0x20 || c == 0x7f;  // other systems' paths, schemes, what does not print
      })) {
    return {};
  }
  const fs::path relative(*name);
  if (relative.is_absolute() || std::find(relative.begin(), relative.end(), "..") != relative.end()) return {};
  std::error_code error;
  const fs::path home = fs::weakly_canonical(folder.empty() ? fs::path(".") : folder, error);
  if (error) return {};
  const fs::path found = fs::weakly_canonical(home / relative, error);
  if (error || std::mismatch(home.begin(), home.end(), found.begin(), found.end()).first != home.end()) return {};
  return found;
}

}  // namespace

GltfFile::GltfFile(std::string_view bytes, bool is_glb, const fs::path& file) : file_(file) {
  const Chunks chunks = is_glb ? SplitGlb(bytes, file) : Chunks{bytes, {}};
  json_ = ParseJson(chunks.json, file);
  chunk_ = chunks.binary;
}

std::string GltfFile::ReadBuffer(const JsonAt& buffer, std::uint64_t index, std::size_t room) const {
  const auto uri = buffer.Find("uri");
  if (!uri) {
    if (index == 0 && !chunk_.empty()) return std::string(chunk_);
    buffer.Fail("has no `uri`, and there is no binary chunk for it");
  }
  const std::string& text = uri->Text();
  if (text.starts_with("data:")) {
    constexpr std::string_view kBase64 = ";base64,";
    const std::size_t at = text.find(kBase64);
    if (at == std::string::npos) uri->Fail("is a data URI without base64");
    const auto bytes = DecodeBase64(std::string_view(text).substr(at + kBase64.size()));
    if (!bytes) uri->Fail("is no base64; the file is broken");
    return *bytes;
  }
  const auto path = Below(file_.parent_path(), text);
  if (!path) uri->Fail("`" + Shown(text) + "` is no file in the mesh's folder; buffers outside it are not read");
  return ReadWhole(*path, "buffer", room);
}

std::string_view GltfFile::Buffer(std::uint64_t index) {
  const auto known = buffers_.find(index);
  if (known != buffers_.end()) return known->second;
  const JsonAt buffer = root().Need("buffers").Element(index);
  const std::uint64_t length = buffer.Need("byteLength").Natural();
  const std::size_t room = kMostBufferBytes - buffer_bytes_;
  if (length > room) buffer.Fail("makes the buffers larger than " + std::to_string(kMostBufferBytes) + " bytes");
  std::string bytes = ReadBuffer(buffer, index, room);
  if (bytes.size() < length) {
    buffer.Fail("should have " + std::to_string(length) + " bytes but has " + std::to_string(bytes.size()) +
                "; the file is cut off");
  }
  bytes.resize(static_cast<std::size_t>(length));
  buffer_bytes_ += bytes.size();
  return buffers_.emplace(index, std::move(bytes)).first->second;
}

}  // namespace alula::geometry::internal
