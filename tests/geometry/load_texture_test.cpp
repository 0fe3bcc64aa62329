#include "geometry/load_texture.h"

#include <gtest/gtest.h>
#include <png.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "base/error.h"

namespace alula::geometry {
namespace {

using Bytes = std::vector<std::uint8_t>;

class LoadTextureTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(::testing::TempDir()) / (std::string("alula_load_texture_") + info->name());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  /// Writes a PNG of `format`, rows from the top.
  std::filesystem::path WritePng(int width, int height, png_uint_32 format, const Bytes& bytes) const {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(width);
    image.height = static_cast<png_uint_32>(height);
    image.format = format;
    const auto file = folder_ / "texture.png";
    EXPECT_NE(png_image_write_to_file(&image, file.c_str(), 0, bytes.data(), 0, nullptr), 0) << image.message;
    return file;
  }
  std::filesystem::path Write(const std::string& text) const {
    std::ofstream(folder_ / "texture.png", std::ios::binary) << text;
    return folder_ / "texture.png";
  }
  static std::string ErrorOf(const std::filesystem::path& file) {
    try {
      LoadTexture(file);
    } catch (const base::InputError& error) {
      const std::string what = error.what();
      return what.starts_with(file.generic_string() + ": ") ? what.substr(file.generic_string().size() + 2) : what;
    }
    return "no error";
  }

  std::filesystem::path folder_;
};

TEST_F(LoadTextureTest, PowersOfTwoAreTakenAsTheyStandFromTheFootUp) {
  const Texture texture = LoadTexture(WritePng(2, 2, PNG_FORMAT_RGB, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}));
  EXPECT_EQ(texture.width, 2);
  EXPECT_EQ(texture.height, 2);
  EXPECT_EQ(texture.rgb, Bytes({7, 8, 9, 10, 11, 12, 1, 2, 3, 4, 5, 6}));
}

TEST_F(LoadTextureTest, GreyIsSpreadOverTheColours) {
  EXPECT_EQ(LoadTexture(WritePng(1, 1, PNG_FORMAT_GRAY, {77})).rgb, Bytes({77, 77, 77}));
}

TEST_F(LoadTextureTest, OtherSizesAreStretchedAcrossTheRim) {
  // Three texels to four: centres at 1/8, 3/8, … of the picture lie at −1/8, 5/8, 11/8 and 17/8 of its texels, so the
  // first takes an eighth of the last and the last an eighth of the first.
  const Texture texture = LoadTexture(WritePng(3, 1, PNG_FORMAT_GRAY, {0, 80, 160}));
  EXPECT_EQ(texture.width, 4);
  EXPECT_EQ(texture.height, 1);
  const Bytes wanted{20, 50, 110, 140};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(texture.rgb[3 * i], wanted[i]);
}

TEST_F(LoadTextureTest, HolesAreWhereAlphaIsBelowHalf) {
  const Texture leaf = LoadTexture(WritePng(2, 1, PNG_FORMAT_RGBA, {9, 8, 7, 255, 6, 5, 4, 30}));
  EXPECT_EQ(leaf.rgb, Bytes({9, 8, 7, 6, 5, 4}));
  EXPECT_EQ(leaf.alpha, Bytes({255, 30}));
  const Texture hazy = LoadTexture(WritePng(2, 1, PNG_FORMAT_RGBA, {9, 8, 7, 255, 6, 5, 4, 128}));
  EXPECT_TRUE(hazy.alpha.empty());  // no holes: nothing to look up
}

TEST_F(LoadTextureTest, WhatIsNoTexture) {
  EXPECT_EQ(ErrorOf(folder_ / "none.png"), "there is no such texture file");
  EXPECT_EQ(ErrorOf(folder_), "is no regular file; name a texture file");
  EXPECT_EQ(ErrorOf(Write("")), "the texture file is empty");
  EXPECT_EQ(ErrorOf(Write("this is text\n")), "is no PNG file; convert the texture to PNG");
  EXPECT_EQ(ErrorOf(WritePng(kMostTexels + 1, 1, PNG_FORMAT_GRAY, Bytes(kMostTexels + 1))),
            "is 4097 x 1 texels; at most 4096 a side are read");
}

TEST_F(LoadTextureTest, EveryCutIsFound) {
  Bytes noise(3 * 16 * 16);
  for (std::size_t i = 0; i < noise.size(); ++i) noise[i] = static_cast<std::uint8_t>(i * i * 31 + i / 7);
  std::ifstream stream(WritePng(16, 16, PNG_FORMAT_RGB, noise), std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(stream), {}};
  constexpr std::size_t kEnd = 12;  // bytes of the last chunk, which holds nothing
  for (std::size_t size = 1; size + kEnd < whole.size(); size += 7) {
    EXPECT_NE(ErrorOf(Write(whole.substr(0, size))), "no error") << size;
  }
}

}  // namespace
}  // namespace alula::geometry
