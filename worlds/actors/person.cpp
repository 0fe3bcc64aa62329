#include "worlds/actors/person.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/random.h"
#include "worlds/actors/body_shapes.h"
#include "worlds/actors/gait.h"
#include "worlds/kit/surface.h"

namespace alula::worlds {
namespace {

using base::RandomStream;
using base::Transform;
using base::Vec3;
using Colour = Eigen::Vector3f;

constexpr double kWeave = 0.5;  // m that one period of cloth covers

/// Indices of materials.
struct Clothes {
  int skin = 0, hair = 0, shirt = 0, trousers = 0, shoes = 0, sleeve = 0;
};

const Colour& Pick(const std::vector<Colour>& colours, RandomStream& random) {
  return colours[random.Index(colours.size())];
}

Clothes DrawClothes(World& world, const std::string& name, std::uint64_t seed, RandomStream& random) {
  static const std::vector<Colour> kSkin{{0.93F, 0.76F, 0.65F},
                                         {0.86F, 0.66F, 0.52F},
                                         {0.72F, 0.52F, 0.38F},
                                         {0.52F, 0.36F, 0.26F},
                                         {0.37F, 0.25F, 0.18F}};
  static const std::vector<Colour> kHair{{0.10F, 0.08F, 0.07F},
                                         {0.24F, 0.15F, 0.09F},
                                         {0.42F, 0.29F, 0.15F},
                                         {0.72F, 0.58F, 0.34F},
                                         {0.62F, 0.61F, 0.60F}};
  static const std::vector<Colour> kShirt{{0.85F, 0.85F, 0.83F}, {0.72F, 0.16F, 0.15F}, {0.15F, 0.30F, 0.58F},
                                          {0.20F, 0.45F, 0.28F}, {0.88F, 0.72F, 0.24F}, {0.30F, 0.30F, 0.33F},
                                          {0.55F, 0.33F, 0.52F}, {0.90F, 0.50F, 0.18F}};
  static const std::vector<Colour> kTrousers{{0.16F, 0.20F, 0.33F},
                                             {0.13F, 0.13F, 0.14F},
                                             {0.45F, 0.40F, 0.31F},
                                             {0.34F, 0.35F, 0.37F},
                                             {0.62F, 0.57F, 0.47F}};
  const auto cloth = [&](const std::string& what, Cloth kind, const Colour& a, const Colour& b) {
    const std::string material = name + "/" + what;
    world.materials.push_back({material, Colour::Ones(), MakeCloth(kind, a, b, 64, seed, material)});
    return static_cast<int>(world.materials.size()) - 1;
  };
  Clothes clothes;
  clothes.skin = AddPlainMaterial(world, name + "/skin", Pick(kSkin, random));
  clothes.hair = AddPlainMaterial(world, name + "/hair", Pick(kHair, random));
  const Colour shirt = Pick(kShirt, random);
  const auto kind = static_cast<Cloth>(random.Index(4));
  clothes.shirt = cloth("shirt", kind, shirt, Pick(kShirt, random));
  const Colour trousers = Pick(kTrousers, random);
  clothes.trousers = cloth("trousers", Cloth::kSpeckled, trousers, 0.8F * trousers);
  clothes.shoes = AddPlainMaterial(world, name + "/shoes",
                                   random.Index(2) == 0 ? Colour(0.12F, 0.10F, 0.09F) : Colour(0.80F, 0.79F, 0.76F));
  clothes.sleeve = random.Index(2) == 0 ? clothes.shirt : clothes.skin;  // long or short
  return clothes;
}

/// Adds links of one body of height h.
class Tailor {
 public:
  Tailor(Actor& actor, double h, const Clothes& clothes, double girth)
      : actor_(actor), h_(h), girth_(girth), clothes_(clothes) {}

  void Trunk() {
    // Rings from the crotch up to the waist, from the waist up to the shoulders; deep as 0.66 of the width.
    Add("pelvis", kPelvis, {}, clothes_.trousers,
        TurnedBody(Scaled({{-0.055, 0.0}, {-0.045, 0.055}, {0.0, 0.092}, {0.05, 0.090}, {0.105, 0.080}, {0.125, 0.0}}),
                   0.70, 1.0, kWeave));
    Add("chest", kChest, {}, clothes_.shirt,
        TurnedBody(Scaled({{-0.03, 0.0},
                           {-0.02, 0.078},
                           {0.05, 0.090},
                           {0.115, 0.105},
                           {0.165, 0.108},
                           {0.195, 0.085},
                           {0.225, 0.032},
                           {0.23, 0.0}}),
                   0.66, 1.0, kWeave));
  }
  void Head() {
    const Vec3 p(0.008 * h_, 0.0, 0.077 * h_);
    Add("neck", kHead, {}, clothes_.skin, geometry::Cylinder{0.031 * h_, 0.04 * h_}, false);
    Add("head", kHead, {base::Quat::Identity(), p}, clothes_.skin,
        Ellipsoid({0.054 * h_, 0.044 * h_, 0.066 * h_}, 1.0));
    Add("nose", kHead, {base::Quat::Identity(), p + Vec3(0.054 * h_, 0.0, -0.004 * h_)}, clothes_.skin,
        geometry::Sphere{0.008 * h_}, false);
    Add("hair", kHead, {base::FromYawPitchRoll(0.0, -0.35, 0.0), p + Vec3(-0.004 * h_, 0.0, 0.006 * h_)}, clothes_.hair,
        TurnedBody(Scaled({{-0.005, 0.0}, {0.0, 0.058}, {0.03, 0.055}, {0.054, 0.037}, {0.068, 0.0}}, 1.0), 1.04, 0.90,
                   1.0),
        false);
  }
  void Arm(const std::string& side, int joint) {
    const Proportions size(h_);
    Add(side + "_upper_arm", joint, {}, clothes_.shirt, Limb(size.upper_arm, 0.030 * h_, 0.023 * h_, kWeave));
    const double hand = 0.055 * h_;
    const double wrist = size.forearm - hand;
    Add(side + "_forearm", joint + 1, {}, clothes_.sleeve, Limb(wrist, 0.022 * h_, 0.016 * h_, kWeave));
    Add(side + "_hand", joint + 1, {base::Quat::Identity(), {0.0, 0.0, -wrist - 0.6 * hand}}, clothes_.skin,
        Ellipsoid({0.020 * h_, 0.013 * h_, 0.9 * hand}, 1.0), false);
  }
  void Leg(const std::string& side, int joint) {
    const Proportions size(h_);
    Add(side + "_thigh", joint, {}, clothes_.trousers, Limb(size.thigh, girth_ * 0.047 * h_, 0.034 * h_, kWeave));
    Add(side + "_shin", joint + 1, {}, clothes_.trousers, Limb(size.shin, 0.034 * h_, 0.024 * h_, kWeave));
    // A shoe: flat sole, lower at the toes.
    const double length = size.toe + size.heel;
    const Vec3 middle(0.5 * (size.toe - size.heel), 0.0, -size.ankle + 0.026 * h_);
    Add(side + "_foot", joint + 2, {base::Quat::Identity(), middle}, clothes_.shoes,
        Frustum({0.5 * length, 0.028 * h_}, {0.30 * length, 0.020 * h_}, 0.026 * h_, 0.13 * length));
  }

 private:
  std::vector<Ring> Scaled(std::vector<Ring> rings) const { return Scaled(std::move(rings), girth_); }
  std::vector<Ring> Scaled(std::vector<Ring> rings, double girth) const {
    for (Ring& ring : rings) ring = {ring.z * h_, ring.radius * h_ * girth};
    return rings;
  }
  /// What lies within the shadow of its neighbours casts none: each one costs.
  void Add(std::string name, int joint, const Transform& X_JL, int material, geometry::Shape shape,
           bool casts_shadow = true) {
    actor_.links.push_back({.name = std::move(name),
                            .shape = std::move(shape),
                            .joint = joint,
                            .X_JL = X_JL,
                            .material = material,
                            .casts_shadow = casts_shadow});
  }

  Actor& actor_;
  double h_;
  double girth_;
  const Clothes& clothes_;
};

}  // namespace

double PersonHeight(std::uint64_t seed, const std::string& name) {
  RandomStream random(seed, "world/actors/" + name + "/height");
  return std::clamp(1.70 + 0.09 * random.Gaussian(), 1.50, 1.95);
}

void AddPerson(World& world, const std::string& name, const Walk& walk, std::uint64_t seed) {
  RandomStream random(seed, "world/actors/" + name + "/look");
  const Clothes clothes = DrawClothes(world, name, seed, random);
  Actor actor{.name = name, .semantic = SemanticClass::kPerson, .links = {}, .motion = walk};
  Tailor tailor(actor, walk.height, clothes, random.Uniform(0.9, 1.15));
  tailor.Trunk();
  tailor.Head();
  tailor.Arm("left", kArmL);
  tailor.Arm("right", kArmR);
  tailor.Leg("left", kThighL);
  tailor.Leg("right", kThighR);
  world.actors.push_back(std::move(actor));
}

}  // namespace alula::worlds
