#include <gtest/gtest.h>

#include "base/error.h"
#include "render/camera_renderer.h"
#include "scenarios/factories.h"
#include "scenarios/gallery/contact_sheet.h"
#include "scenarios/gallery/texture_statistics.h"
#include "scenarios/gallery/viewpoints.h"
#include "sim/physics_world.h"

namespace alula::scenarios {

void PrintTo(const CatalogEntry& entry, std::ostream* out) { *out << entry.name; }  // in the names of tests

namespace gallery {
namespace {

constexpr int kWidth = 752;
constexpr int kHeight = 480;

std::vector<std::uint8_t> Flat(std::uint8_t value) {
  return std::vector<std::uint8_t>(static_cast<std::size_t>(kWidth) * kHeight, value);
}

TEST(TextureStatistics, BareWallOffersNothing) {
  const PictureTexture texture = TextureOf(Flat(120), kWidth, kHeight);
  EXPECT_EQ(texture.corners, 0.0);
  EXPECT_EQ(texture.lines, 0.0);
  EXPECT_EQ(texture.bare, 1.0);
  EXPECT_DOUBLE_EQ(texture.mean, 120.0);  // OpenCV divides by a rounded reciprocal
  EXPECT_EQ(texture.contrast, 0.0);
}

TEST(TextureStatistics, CountsTheCornersOfABoard) {
  std::vector<std::uint8_t> board = Flat(60);
  constexpr int kSide = 48;  // px: 16 columns of squares fit into 752 px and 10 rows into 480
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      if ((x / kSide + y / kSide) % 2 == 0) board[static_cast<std::size_t>(y * kWidth + x)] = 190;
    }
  }
  const PictureTexture texture = TextureOf(board, kWidth, kHeight);
  constexpr double kCrossings = 15 * 9;
  // A crossing strengthens its 7 × 7 px: it lies in one to four of the squares of 8 px that keep a corner each.
  EXPECT_GE(texture.corners, kCrossings);
  EXPECT_LE(texture.corners, 4 * kCrossings);
  EXPECT_GT(texture.lines, 20.0);
}

/// Half a step up along one line: an edge, but no corner.
TEST(TextureStatistics, AnEdgeIsALineAndNoCorner) {
  std::vector<std::uint8_t> edge = Flat(60);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = kWidth / 2; x < kWidth; ++x) edge[static_cast<std::size_t>(y * kWidth + x)] = 190;
  }
  const PictureTexture texture = TextureOf(edge, kWidth, kHeight);
  EXPECT_EQ(texture.corners, 0.0);
  EXPECT_GE(texture.lines, 1.0);
  constexpr double kColumns = kWidth / 32;  // one of them holds the line
  EXPECT_NEAR(texture.bare, 1.0 - 1.0 / kColumns, 0.01);
}

TEST(Viewpoints, RandomOnesAreFreeAndSeeded) {
  const worlds::World world = worlds::MakeWorld(worlds::CourtyardConfig{}, 3);
  const auto views = RandomViewpoints(world, 12, 3);
  const auto again = RandomViewpoints(world, 12, 3);
  const auto other = RandomViewpoints(world, 12, 4);
  ASSERT_EQ(views.size(), 12U);
  vehicles::VehicleBody body;
  vehicles::Part ball;
  ball.name = "ball";
  ball.shape = geometry::Sphere{0.3};
  body.parts = {ball};
  body.prescribed = true;
  sim::PhysicsWorld physics(world, body, {});
  for (std::size_t i = 0; i < views.size(); ++i) {
    EXPECT_EQ(views[i].p, again[i].p);
    EXPECT_NE(views[i].p, other[i].p);
    physics.MovePrescribed({{base::Quat::Identity(), views[i].p}, base::Vec3::Zero(), base::Vec3::Zero()});
    EXPECT_GT(physics.HullClearance(0.2).distance, 0.09);  // 0.4 m free about the camera, the ball has 0.3
  }
}

TEST(ContactSheet, ShowsEveryPassOfEveryViewpoint) {
  worlds::CourtyardConfig small;
  small.texture_size = 64;
  const ContactSheet sheet = MakeContactSheet(small, "courtyard", 1, "raster");
  ASSERT_EQ(sheet.rgb.size(), 3U * static_cast<std::size_t>(sheet.width) * static_cast<std::size_t>(sheet.height));
  EXPECT_GT(sheet.triangles, 1000U);
  EXPECT_EQ(sheet.objects, worlds::MakeWorld(small, 1).objects.size());
}

/// Every world of the catalog, whatever is added to it.
class EachWorld : public testing::TestWithParam<CatalogEntry> {
 protected:
  static std::vector<std::uint8_t> PictureOf(std::uint64_t seed) {
    const auto world = MakeWorld(LoadWorld(GetParam().file, {}, seed), seed);
    const auto renderer = render::MakeRenderer("raster", *world, {});
    std::vector<std::uint8_t> bytes;
    for (const Viewpoint& viewpoint : NamedViewpoints(*world)) {
      render::View view;
      view.X_WC = viewpoint.X_WC;
      view.intrinsics = WideCamera(160, 120);
      render::Picture picture;
      renderer->Colour(view, picture);
      bytes.insert(bytes.end(), picture.bytes.begin(), picture.bytes.end());
    }
    return bytes;
  }
};

TEST_P(EachWorld, LooksTheSameForTheSameSeedAndOtherwiseForAnother) {
  const std::vector<std::uint8_t> first = PictureOf(1);
  EXPECT_EQ(first, PictureOf(1));
  EXPECT_NE(first, PictureOf(2));
}

std::vector<CatalogEntry> CatalogWorlds() {
  std::vector<CatalogEntry> worlds = ListCatalogs();
  std::erase_if(worlds, [](const CatalogEntry& entry) { return entry.kind != "world"; });
  return worlds;
}

INSTANTIATE_TEST_SUITE_P(Catalog, EachWorld, testing::ValuesIn(CatalogWorlds()),
                         [](const auto& param) { return param.param.name; });

}  // namespace
}  // namespace gallery
}  // namespace alula::scenarios
