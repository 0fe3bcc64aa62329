#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "base/error.h"
#include "worlds/kit/surface.h"
#include "worlds/kit/terrain.h"
#include "worlds/weather.h"

namespace alula::worlds {
namespace {

using base::Vec2;
using base::Vec3;

HeightField Hilly(std::uint64_t seed) {
  base::RandomStream random(seed, "test/hills");
  HeightField field = FlatField(64.0, 0.5);
  AddHills(field, {.height = 0.8, .wavelength = 20.0}, random);
  return field;
}

TEST(Terrain, HillsHaveTheHeightAsked) {
  double squares = 0.0;
  double sum = 0.0;
  double count = 0.0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    for (const float z : Hilly(seed).z) {
      sum += z;
      squares += static_cast<double>(z) * z;
      ++count;
    }
  }
  const double deviation = std::sqrt(squares / count - (sum / count) * (sum / count));
  EXPECT_NEAR(deviation, 0.8, 0.2);  // ten wavelengths a field and twenty fields: the deviation itself spreads by 10 %
}

TEST(Terrain, HeightIsThatOfTheTriangles) {
  const HeightField field = Hilly(3);
  for (const auto& [x, y] : {std::pair{0.1, 0.3}, {0.3, 0.1}, {5.45, -7.2}, {-31.9, 31.9}}) {
    const Vec2 p(x, y);
    const Vec2 q = (p - field.low) / field.cell;
    const int i = static_cast<int>(q.x());
    const int j = static_cast<int>(q.y());
    const double u = q.x() - i;
    const double v = q.y() - j;
    const double expected = u >= v ? field.At(i, j) + u * (field.At(i + 1, j) - field.At(i, j)) +
                                         v * (field.At(i + 1, j + 1) - field.At(i + 1, j))
                                   : field.At(i, j) + v * (field.At(i, j + 1) - field.At(i, j)) +
                                         u * (field.At(i + 1, j + 1) - field.At(i, j + 1));
    EXPECT_NEAR(HeightAt(field, p), expected, 1e-6);
  }
}

TEST(Terrain, LevelIsFlatInsideAndUntouchedOutside) {
  HeightField field = Hilly(4);
  const HeightField before = field;
  Level(field, {3.0, -2.0}, 4.0, 3.0, 1.5);
  EXPECT_NEAR(HeightAt(field, {4.0, -3.0}), 1.5, 1e-6);
  EXPECT_EQ(HeightAt(field, {20.0, 20.0}), HeightAt(before, {20.0, 20.0}));
  EXPECT_NEAR((NormalAt(field, {3.0, -2.0}) - Vec3::UnitZ()).norm(), 0.0, 1e-6);
}

TEST(Terrain, TilesShareTheirBordersToTheBit) {
  World world;
  const Surface surface{{0}, 8.0};
  base::RandomStream random(1, "test/tiles");
  AddTerrain(world, "ground", Hilly(5), surface, random);
  ASSERT_EQ(world.objects.size(), 64U);
  std::map<std::pair<float, float>, std::pair<float, Eigen::Vector3f>> seen;
  int shared = 0;
  for (const Object& object : world.objects) {
    for (const auto& vertex : std::get<geometry::MeshShape>(object.shape).mesh->vertices) {
      const auto [at, is_new] =
          seen.try_emplace({vertex.position.x(), vertex.position.y()}, std::pair{vertex.position.z(), vertex.normal});
      if (is_new) continue;
      ++shared;
      EXPECT_EQ(at->second.first, vertex.position.z());
      EXPECT_EQ(at->second.second, vertex.normal);
    }
  }
  EXPECT_GT(shared, 1000);
}

TEST(Surface, VariantsAreEqualAlongTheirRimsAndDifferWithin) {
  const auto variants = MakeTextureVariants(Pattern::kGravel, {}, 128, 7, "test", 3);
  ASSERT_EQ(variants.size(), 3U);
  const auto texel = [&](std::size_t variant, int x, int y) {
    return variants[variant]->rgb[3 * static_cast<std::size_t>(y * 128 + x)];
  };
  int different = 0;
  for (int i = 0; i < 128; ++i) {
    for (std::size_t variant = 1; variant < 3; ++variant) {
      EXPECT_EQ(texel(0, 64, i), texel(variant, 64, i));
      EXPECT_EQ(texel(0, i, 64), texel(variant, i, 64));
      different += texel(0, 10, i) != texel(variant, 10, i);
    }
  }
  EXPECT_GT(different, 200);
}

TEST(Surface, TiledBoxHasTheBoxsSurface) {
  World world;
  base::RandomStream random(1, "test/box");
  AddTiledBox(world, "wall", {13.0, 0.2, 5.0}, {}, {{0}, 4.0}, SemanticClass::kWall, random);
  EXPECT_EQ(world.objects.size(), 3U);
  double area = 0.0;
  for (const Object& object : world.objects) {
    const geometry::Mesh& mesh = *std::get<geometry::MeshShape>(object.shape).mesh;
    for (const auto& t : mesh.triangles) {
      const Eigen::Vector3f a = mesh.vertices[t[1]].position - mesh.vertices[t[0]].position;
      const Eigen::Vector3f b = mesh.vertices[t[2]].position - mesh.vertices[t[0]].position;
      const Eigen::Vector3f n = a.cross(b);
      EXPECT_GT(n.dot(mesh.vertices[t[0]].normal), 0.0F);  // counter-clockwise from outside
      area += 0.5 * n.norm();
    }
  }
  EXPECT_NEAR(area, 2.0 * (13.0 * 0.2 + 13.0 * 5.0 + 0.2 * 5.0), 1e-4);
}

TEST(Weather, CloudsTakeTheSunAndNightIsDark) {
  WeatherConfig weather;
  weather.sun_elevation = 0.8;
  weather.cloud = 0.0;
  const Light clear = DrawLight(weather, 1);
  weather.cloud = 1.0;
  const Light overcast = DrawLight(weather, 1);
  EXPECT_LT(overcast.sun, 0.06F * clear.sun);
  EXPECT_GT(overcast.ambient, clear.ambient);
  weather.hour = WeatherConfig::Hour::kNight;
  weather.cloud = 0.0;
  const Light night = DrawLight(weather, 1);
  EXPECT_LT(night.sun, 0.01F);
  EXPECT_LT(night.ambient, 0.01F);
}

TEST(Weather, ContradictionsAreSaid) {
  const auto complaint = [](WeatherConfig weather) {
    base::Description d;
    Describe(d, weather);
    for (const auto& [key, check] : d.checks()) {
      if (const std::string wrong = check(); !wrong.empty()) return key + " " + wrong;
    }
    return std::string();
  };
  EXPECT_EQ(complaint({}), "");
  WeatherConfig dusk;
  dusk.hour = WeatherConfig::Hour::kDusk;
  dusk.sun_elevation = 0.8;
  EXPECT_EQ(complaint(dusk), "sun_elevation must be at most 10 deg at dusk; or set hour: day");
  WeatherConfig low;
  low.sun_elevation = 0.02;
  EXPECT_EQ(complaint(low), "sun_elevation must be at least 5 deg by day; or set hour: dusk");
  WeatherConfig storm;
  storm.fog = Fog{};
  storm.wind.speed = 15.0;
  EXPECT_NE(complaint(storm).find("fog contradicts a wind above 10 m/s"), std::string::npos);
}

}  // namespace
}  // namespace alula::worlds
