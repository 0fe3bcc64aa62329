#include "worlds/indoor/prints.h"

#include <gtest/gtest.h>

#include <numeric>

namespace alula::worlds {
namespace {

const geometry::Texture& TextureAt(const World& world, int material) {
  return *world.materials.at(static_cast<std::size_t>(material)).texture;
}

double MeanOf(const geometry::Texture& texture) {
  return std::accumulate(texture.rgb.begin(), texture.rgb.end(), 0.0) / static_cast<double>(texture.rgb.size()) / 255.0;
}

TEST(Prints, AreTheSameForOneSeedAndDifferBetweenSeeds) {
  World world;
  const auto differ = [&](int a, int b) { return TextureAt(world, a).rgb != TextureAt(world, b).rgb; };
  EXPECT_FALSE(differ(AddPlayRug(world, "a", 128, 1), AddPlayRug(world, "a", 128, 1)));
  EXPECT_TRUE(differ(AddPlayRug(world, "a", 128, 1), AddPlayRug(world, "a", 128, 2)));
  EXPECT_TRUE(differ(AddPlayRug(world, "a", 128, 1), AddPlayRug(world, "b", 128, 1)));
  EXPECT_FALSE(differ(AddSpeckTape(world, "t", 256, 16.0, 1), AddSpeckTape(world, "t", 256, 16.0, 1)));
  EXPECT_TRUE(differ(AddSpeckTape(world, "t", 256, 16.0, 1), AddSpeckTape(world, "t", 256, 16.0, 2)));
  EXPECT_TRUE(differ(AddTagGrid(world, "g", 128, 1), AddTagGrid(world, "g", 128, 2)));
  EXPECT_TRUE(differ(AddQuilt(world, "q", 64, 1), AddQuilt(world, "q", 64, 2)));
}

TEST(Prints, ACheckerboardIsHalfBlackWithinItsRim) {
  World world;
  const geometry::Texture& board = TextureAt(world, AddCheckerboard(world, "board", 512, 8, 8));
  // 0.9² of it has 32 of 64 squares at 0.05, the rest is 0.95; texels on borders go to one side: 1 % at 512.
  EXPECT_NEAR(MeanOf(board), 0.81 * 0.5 + 0.19 * 0.95, 0.01);
}

TEST(Prints, TapeIsBlackWithAFewWhiteScraps) {
  World world;
  const geometry::Texture& tape = TextureAt(world, AddSpeckTape(world, "tape", 1024, 16.0, 3));
  EXPECT_EQ(tape.width, 16 * tape.height);
  EXPECT_GT(MeanOf(tape), 0.1);
  EXPECT_LT(MeanOf(tape), 0.35);
}

TEST(Prints, ABoardShowsThePictureOnOneFace) {
  World world;
  const std::size_t i = AddPrintedBox(world, "board", {2.0, 1.0, 0.1}, {}, 2, AddCheckerboard(world, "c", 64, 4, 4));
  const auto& mesh = *std::get<geometry::MeshShape>(world.objects[i].shape).mesh;
  int corners = 0;
  for (const auto& v : mesh.vertices) {
    if ((v.uv - Eigen::Vector2f(0.01F, 0.01F)).norm() < 1e-6F) continue;
    ++corners;
    EXPECT_FLOAT_EQ(v.normal.z(), 1.0F);
    EXPECT_NEAR(v.uv.x(), 0.5F + 0.496F * v.position.x(), 1e-5F);         // half a length is 1 m
    EXPECT_NEAR(v.uv.y(), 0.5F + 0.496F * 2.0F * v.position.y(), 1e-5F);  // half a width 0.5 m
  }
  EXPECT_EQ(corners, 4);
}

}  // namespace
}  // namespace alula::worlds
