#include "stack/slam/map_file.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <string_view>
#include <type_traits>
#include <utility>

#include "base/error.h"

namespace alula::stack::slam {
namespace {

static_assert(std::endian::native == std::endian::little, "a map's file is little-endian");

constexpr std::string_view kMagic = "ALULAMAP";
constexpr std::uint32_t kVersion = 2;

struct Writer {
  static constexpr bool kReads = false;
  std::vector<std::uint8_t> bytes{};

  void Raw(const void* data, std::size_t size) {
    const auto* p = static_cast<const std::uint8_t*>(data);
    bytes.insert(bytes.end(), p, p + size);
  }
};

/// Thrown inside alone.
struct Broken {
  const char* why;
};

struct Reader {
  static constexpr bool kReads = true;
  std::span<const std::uint8_t> rest;

  void Raw(void* data, std::size_t size) {
    if (rest.size() < size) throw Broken{"it ends too early"};
    std::memcpy(data, rest.data(), size);
    rest = rest.subspan(size);
  }
};

// One description serves both ways.

template <typename Archive, typename T>
requires std::is_arithmetic_v<T>
void Visit(Archive& a, T& value) {
  a.Raw(&value, sizeof(T));
  if constexpr (Archive::kReads && std::is_floating_point_v<T>) {
    if (!std::isfinite(value)) throw Broken{"a number in it is not finite"};
  }
}

template <typename Archive, int N>
void Visit(Archive& a, Eigen::Matrix<double, N, 1>& v) {
  for (int i = 0; i < N; ++i) Visit(a, v[i]);
}

template <typename Archive>
void Visit(Archive& a, base::Transform& X) {
  for (double* q : {&X.q.x(), &X.q.y(), &X.q.z(), &X.q.w()}) Visit(a, *q);
  Visit(a, X.p);
  if (Archive::kReads && std::abs(X.q.norm() - 1.0) > 1e-6) throw Broken{"a rotation in it is none"};
}

template <typename Archive>
void Visit(Archive& a, base::Time& t) {
  Visit(a, t.ns);
}

template <typename Archive>
void Visit(Archive& a, features::Descriptor& d) {
  for (auto& word : d) Visit(a, word);
}

template <typename Archive, typename T>
void Visit(Archive& a, std::optional<T>& value) {
  std::uint8_t there = value ? 1 : 0;
  Visit(a, there);
  if (there > 1) throw Broken{"it is no map"};
  if constexpr (Archive::kReads) {
    value.reset();
    if (there != 0) value.emplace();
  }
  if (value) Visit(a, *value);
}

template <typename Archive, typename T>
void Visit(Archive& a, std::vector<T>& values) {
  auto count = static_cast<std::uint32_t>(values.size());
  Visit(a, count);
  if constexpr (Archive::kReads) {
    values.clear();  // grows with what is really there, whatever the count says
    for (std::uint32_t i = 0; i < count; ++i) Visit(a, values.emplace_back());
  } else {
    for (T& value : values) Visit(a, value);
  }
}

template <typename Archive>
void Visit(Archive& a, PlacePoint& p) {
  Visit(a, p.pixel);
  Visit(a, p.normalised);
  Visit(a, p.scale);
  Visit(a, p.angle);
  Visit(a, p.descriptor);
  Visit(a, p.p_C);
}

template <typename Archive>
void Visit(Archive& a, PlaceLine& l) {
  for (auto& v : l.pixels) Visit(a, v);
  for (auto& v : l.normalised) Visit(a, v);
  Visit(a, l.descriptor);
  std::optional<base::Vec6> ends;
  if (l.ends_C) {
    ends.emplace();
    *ends << (*l.ends_C)[0], (*l.ends_C)[1];
  }
  Visit(a, ends);
  if (ends) l.ends_C = {base::Vec3(ends->head<3>()), base::Vec3(ends->tail<3>())};
}

template <typename Archive>
void Visit(Archive& a, RelativeMotion& m) {
  Visit(a, m.X_FT);
  Visit(a, m.sigma);
}

template <typename Archive>
void Visit(Archive& a, Keyframe& k) {
  Visit(a, k.part);
  Visit(a, k.seq);
  Visit(a, k.stamp);
  Visit(a, k.X_OB);
  Visit(a, k.X_MB);
  Visit(a, k.up_B);
  Visit(a, k.view.points);
  Visit(a, k.view.lines);
  Visit(a, k.view.focal);
  Visit(a, k.view.focal_baseline);
  Visit(a, k.view.up_C);
  Visit(a, k.right);
  Visit(a, k.landmarks);
  Visit(a, k.from_previous);
  Visit(a, k.previous);
}

template <typename Archive>
void Visit(Archive& a, Landmark::Sight& s) {
  Visit(a, s.keyframe);
  Visit(a, s.feature);
}

template <typename Archive>
void Visit(Archive& a, Landmark& l) {
  Visit(a, l.part);
  Visit(a, l.p_M);
  Visit(a, l.descriptor);
  Visit(a, l.normal);
  Visit(a, l.reference_distance);
  Visit(a, l.reference_scale);
  Visit(a, l.born);
  Visit(a, l.sights);
}

template <typename Archive, typename T>
void Visit(Archive& a, std::unique_ptr<T>& owned) {
  if constexpr (Archive::kReads) owned = std::make_unique<T>();
  Visit(a, *owned);
}

template <typename Archive>
void Visit(Archive& a, Map& map) {
  Visit(a, map.eyes.X_BL);
  Visit(a, map.eyes.X_LR);
  Visit(a, map.anchors);
  Visit(a, map.keyframes);
  Visit(a, map.landmarks);
}

/// New ids of what is there, by old ones; −1: dropped.
template <typename T>
std::vector<int> Renumbered(const std::vector<std::unique_ptr<T>>& things) {
  std::vector<int> ids;
  int next = 0;
  for (const auto& thing : things) ids.push_back(thing ? next++ : -1);
  return ids;
}

/// The map without gaps.
Map Packed(const Map& map) {
  const std::vector<int> keyframe = Renumbered(map.keyframes), landmark = Renumbered(map.landmarks);
  const auto at = [](const std::vector<int>& ids, int id) { return id < 0 ? -1 : ids[static_cast<std::size_t>(id)]; };
  Map packed;
  packed.eyes = map.eyes;
  for (const int anchor : map.anchors) packed.anchors.push_back(at(keyframe, anchor));
  for (const auto& k : map.keyframes) {
    if (!k) continue;
    auto copy = std::make_unique<Keyframe>(*k);
    copy->id = at(keyframe, k->id);
    copy->previous = at(keyframe, k->previous);
    for (int& l : copy->landmarks) l = at(landmark, l);
    packed.keyframes.push_back(std::move(copy));
  }
  for (const auto& l : map.landmarks) {
    if (!l) continue;
    auto copy = std::make_unique<Landmark>(*l);
    for (Landmark::Sight& s : copy->sights) s.keyframe = at(keyframe, s.keyframe);
    copy->born = copy->sights.front().keyframe;
    packed.landmarks.push_back(std::move(copy));
  }
  return packed;
}

bool Inside(int id, std::size_t count) { return id >= 0 && static_cast<std::size_t>(id) < count; }

/// Throws where something names what is not there.
void CheckLinks(Map& map) {
  const std::size_t keyframes = map.keyframes.size(), landmarks = map.landmarks.size(), parts = map.anchors.size();
  for (std::size_t i = 0; i < parts; ++i) {
    const int anchor = map.anchors[i];
    const bool joined = anchor == -1;
    if (!joined && (!Inside(anchor, keyframes) || map.keyframe(anchor).part != static_cast<int>(i)))
      throw Broken{"a part of it has no keyframe"};
  }
  for (std::size_t i = 0; i < keyframes; ++i) {
    Keyframe& k = map.keyframe(static_cast<int>(i));
    k.id = static_cast<int>(i);
    const bool whole = Inside(k.part, parts) && map.anchors[static_cast<std::size_t>(k.part)] >= 0 &&
                       k.previous >= -1 && k.previous < k.id && k.right.size() == k.view.points.size() &&
                       k.landmarks.size() == k.view.points.size();
    if (!whole) throw Broken{"a keyframe in it is broken"};
    for (std::size_t f = 0; f < k.landmarks.size(); ++f) {
      const int l = k.landmarks[f];
      if (l == -1) continue;
      if (!Inside(l, landmarks)) throw Broken{"a keyframe in it sees what is not there"};
      const auto& sights = map.landmark(l).sights;
      bool known = false;
      for (const Landmark::Sight& s : sights) known = known || (s.keyframe == k.id && s.feature == static_cast<int>(f));
      if (!known) throw Broken{"a keyframe and a landmark in it disagree"};
    }
  }
  for (std::size_t i = 0; i < landmarks; ++i) {
    const auto& l = map.landmarks[i];
    if (l->sights.empty() || !Inside(l->born, keyframes)) throw Broken{"a landmark in it was seen by nobody"};
    int before = -1;
    for (const Landmark::Sight& s : l->sights) {
      const bool whole = Inside(s.keyframe, keyframes) && s.keyframe > before &&
                         Inside(s.feature, map.keyframe(s.keyframe).landmarks.size()) &&
                         map.keyframe(s.keyframe).part == l->part &&
                         map.keyframe(s.keyframe).landmarks[static_cast<std::size_t>(s.feature)] == static_cast<int>(i);
      if (!whole) throw Broken{"a landmark in it is broken"};
      before = s.keyframe;
    }
  }
}

}  // namespace

std::vector<std::uint8_t> ToBytes(const Map& map) {
  Writer writer;
  writer.Raw(kMagic.data(), kMagic.size());
  std::uint32_t version = kVersion;
  Visit(writer, version);
  Map packed = Packed(map);
  Visit(writer, packed);
  return std::move(writer.bytes);
}

Map MapFromBytes(std::span<const std::uint8_t> bytes, const std::string& name) {
  const bool ours = bytes.size() >= kMagic.size() && std::memcmp(bytes.data(), kMagic.data(), kMagic.size()) == 0;
  if (!ours) throw base::InputError(name + ": is no map; `alula slam --save-map` writes one");
  Reader reader{bytes.subspan(kMagic.size())};
  try {
    std::uint32_t version = 0;
    Visit(reader, version);
    if (version != kVersion) throw Broken{"it is of another version"};
    Map map;
    Visit(reader, map);
    if (!reader.rest.empty()) throw Broken{"it goes on after its end"};
    CheckLinks(map);
    return map;
  } catch (const Broken& broken) {
    throw base::InputError(name + ": cannot be used as a map: " + broken.why);
  }
}

Map LoadMap(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary | std::ios::ate);
  if (!stream) throw base::InputError(file.string() + ": cannot be read; expected a map");
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(stream.tellg()));
  stream.seekg(0);
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!stream) throw base::InputError(file.string() + ": cannot be read");
  return MapFromBytes(bytes, file.string());
}

}  // namespace alula::stack::slam
