#include <array>

#include "worlds/furniture.h"
#include "worlds/textures.h"

namespace alula::worlds {
namespace {

struct Look {
  const char* name;
  Pattern pattern;
  Palette palette;
};

// Colours as displayed. Dark and light lie far apart, so that grey pictures have contrast in sun and shade.
const std::array<Look, 3> kGround{{
    {"paving", Pattern::kPaving, {{0.16F, 0.15F, 0.14F}, {0.86F, 0.83F, 0.78F}}},
    {"gravel", Pattern::kGravel, {{0.20F, 0.18F, 0.15F}, {0.88F, 0.84F, 0.76F}}},
    {"cobbles", Pattern::kRubble, {{0.12F, 0.13F, 0.14F}, {0.80F, 0.82F, 0.82F}}},
}};
const std::array<Look, 5> kWall{{
    {"brick", Pattern::kBrick, {{0.24F, 0.08F, 0.06F}, {0.92F, 0.70F, 0.60F}}},
    {"plaster", Pattern::kPlaster, {{0.25F, 0.22F, 0.18F}, {1.00F, 0.96F, 0.86F}}},
    {"concrete", Pattern::kConcrete, {{0.14F, 0.14F, 0.15F}, {0.90F, 0.91F, 0.92F}}},
    {"rubble", Pattern::kRubble, {{0.15F, 0.13F, 0.10F}, {0.92F, 0.87F, 0.76F}}},
    {"boards", Pattern::kWood, {{0.14F, 0.08F, 0.04F}, {0.85F, 0.68F, 0.47F}}},
}};
const std::array<Palette, 6> kSignal{{
    {{0.45F, 0.02F, 0.03F}, {1.00F, 0.98F, 0.95F}},
    {{0.03F, 0.05F, 0.30F}, {1.00F, 0.88F, 0.20F}},
    {{0.02F, 0.02F, 0.02F}, {1.00F, 0.60F, 0.10F}},
    {{0.02F, 0.22F, 0.08F}, {0.98F, 1.00F, 0.95F}},
    {{0.25F, 0.02F, 0.28F}, {0.95F, 0.95F, 1.00F}},
    {{0.02F, 0.20F, 0.25F}, {1.00F, 0.95F, 0.80F}},
}};

int Add(World& world, const std::string& name, Pattern pattern, const Palette& palette, int size, std::uint64_t seed) {
  world.materials.push_back({name, Eigen::Vector3f::Ones(), MakeTexture(pattern, palette, size, seed, name)});
  return static_cast<int>(world.materials.size()) - 1;
}

}  // namespace

Looks AddCourtyardMaterials(World& world, int texture_size, std::uint64_t seed) {
  const int small = texture_size / 2;
  Looks looks;
  for (const Look& l : kGround) looks.ground.push_back(Add(world, l.name, l.pattern, l.palette, texture_size, seed));
  for (const Look& l : kWall) looks.wall.push_back(Add(world, l.name, l.pattern, l.palette, texture_size, seed));
  base::RandomStream random(seed, "world/gate colours");
  std::vector<Palette> palettes(kSignal.begin(), kSignal.end());
  for (int i = 0; i < 5; ++i) {
    const std::size_t pick = random.Index(palettes.size());
    looks.gate.push_back(Add(world, "gate" + std::to_string(i), Pattern::kSignal, palettes[pick], small, seed));
    palettes.erase(palettes.begin() + static_cast<std::ptrdiff_t>(pick));
  }
  const Palette leaves{{0.04F, 0.10F, 0.03F}, {0.62F, 0.80F, 0.35F}};
  const Palette needles{{0.02F, 0.08F, 0.06F}, {0.50F, 0.68F, 0.45F}};
  looks.foliage = {Add(world, "leaves", Pattern::kFoliage, leaves, small, seed),
                   Add(world, "needles", Pattern::kFoliage, needles, small, seed)};
  looks.bark = Add(world, "bark", Pattern::kBark, {{0.08F, 0.06F, 0.04F}, {0.70F, 0.60F, 0.50F}}, small, seed);
  looks.wood = Add(world, "wood", Pattern::kWood, {{0.16F, 0.09F, 0.04F}, {0.95F, 0.80F, 0.58F}}, small, seed);
  looks.stone = Add(world, "stone", Pattern::kPlaster, {{0.18F, 0.18F, 0.19F}, {0.93F, 0.92F, 0.88F}}, small, seed);
  looks.pad = Add(world, "pad", Pattern::kPad, {{0.06F, 0.08F, 0.10F}, {0.95F, 0.93F, 0.85F}}, small, seed);
  return looks;
}

}  // namespace alula::worlds
