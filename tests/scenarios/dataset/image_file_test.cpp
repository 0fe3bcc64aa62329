// Images of recordings, PNG and JPEG, and depth.
#include "scenarios/dataset/image_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "scenarios/dataset/jpeg.h"
#include "scenarios/dataset/png.h"
#include "stack/interface/grey.h"
#include "tests/scenarios/dataset/jpeg_encoder.h"
#include "tests/scenarios/dataset/synthetic.h"
#include "tests/scenarios/temporary_folder.h"

namespace alula::scenarios::dataset {
namespace {

using scenarios::testing::TemporaryFolder;
using testing::Complaint;

/// Slow waves, which JPEG keeps to a few grey levels.
stack::Image Waves(int width, int height, stack::PixelFormat format) {
  stack::Image image = testing::RandomImage(width, height, format, 1);
  const int channels = format == stack::PixelFormat::kGrey8 ? 1 : 3;
  std::vector<std::uint8_t> bytes(image.bytes->size());
  for (int v = 0; v < height; ++v) {
    for (int i = 0; i < width * channels; ++i) {
      const double wave = std::sin(0.1 * (i / channels) + 0.07 * v + i % channels);
      bytes[static_cast<std::size_t>(v * image.stride + i)] = static_cast<std::uint8_t>(128 + 100 * wave);
    }
  }
  image.bytes = std::make_shared<const std::vector<std::uint8_t>>(std::move(bytes));
  return image;
}

TEST(Jpeg, ComesBackAsItWasSeen) {
  for (const auto format : {stack::PixelFormat::kGrey8, stack::PixelFormat::kRgb8}) {
    for (const auto& [width, height] : {std::pair{64, 48}, std::pair{37, 29}, std::pair{1, 1}, std::pair{9, 200}}) {
      const stack::Image was = Waves(width, height, format);
      const stack::Image is = DecodeJpeg(testing::EncodeJpeg(was), "a.jpg");
      ASSERT_EQ(is.width, width);
      ASSERT_EQ(is.height, height);
      ASSERT_EQ(is.format, format);
      const auto a = testing::Pixels(was), b = testing::Pixels(is);
      ASSERT_EQ(a.size(), b.size());
      // Quantised to steps of a few levels at quality 95; a colour's channel adds its chroma's error times 1.77.
      for (std::size_t i = 0; i < a.size(); ++i) ASSERT_NEAR(a[i], b[i], 12) << i;
    }
  }
}

TEST(Jpeg, BrokenFilesAreRefused) {
  const std::string whole = testing::EncodeJpeg(Waves(64, 48, stack::PixelFormat::kRgb8));
  EXPECT_TRUE(LooksLikeJpeg(whole));
  EXPECT_FALSE(LooksLikeJpeg("\x89PNG"));
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{2}, std::size_t{100}, whole.size() / 2, whole.size() - 2}) {
    const std::string said = Complaint([&] { DecodeJpeg(whole.substr(0, size), "cut.jpg"); });
    EXPECT_TRUE(said.starts_with("cut.jpg: is ")) << size << " " << said;
  }
  // A header that promises 65500 x 65500 pixels: refused before anything is made for them.
  std::string vast = whole;
  const std::size_t frame = vast.find("\xff\xc0");
  ASSERT_NE(frame, std::string::npos);
  for (const std::size_t i : {5u, 7u}) vast.replace(frame + i, 2, "\xff\xdc");
  EXPECT_NE(Complaint([&] { DecodeJpeg(vast, "vast.jpg"); }).find("67 million"), std::string::npos);
  for (const std::size_t i : {5u, 7u}) vast.replace(frame + i, 2, "\x1f\x40");
  EXPECT_NE(Complaint([&] { DecodeJpeg(vast, "vast.jpg"); }).find("ends early"), std::string::npos);
}

TEST(ImageFile, IsWhatItsBytesSay) {
  const TemporaryFolder folder("image_file");
  const stack::Image image = Waves(40, 30, stack::PixelFormat::kRgb8);
  std::ofstream(folder.path() / "a.png", std::ios::binary) << testing::EncodeJpeg(image);  // a wrong name
  std::ofstream(folder.path() / "b.jpg", std::ios::binary) << EncodePng(image);
  std::ofstream(folder.path() / "c.jpg", std::ios::binary) << "text";
  EXPECT_EQ(ReadImage(folder.path() / "a.png").width, 40);
  EXPECT_EQ(testing::Pixels(ReadImage(folder.path() / "b.jpg")), testing::Pixels(image));
  EXPECT_NE(Complaint([&] { ReadImage(folder.path() / "c.jpg"); }), "");
  EXPECT_NE(Complaint([&] { ReadImage(folder.path() / "d.jpg"); }).find("cannot be read"), std::string::npos);
}

TEST(ToGrey, IsTheLuma) {
  const stack::Image colour = testing::RandomImage(31, 17, stack::PixelFormat::kRgb8, 4);
  const stack::Image grey = stack::ToGrey(colour);
  ASSERT_EQ(grey.format, stack::PixelFormat::kGrey8);
  EXPECT_EQ(grey.stride, 31);
  for (int v = 0; v < 17; ++v) {
    for (int u = 0; u < 31; ++u) {
      const std::uint8_t* p = colour.Row(v) + 3 * u;
      EXPECT_NEAR(grey.Row(v)[u], 0.299 * p[0] + 0.587 * p[1] + 0.114 * p[2], 0.505);
    }
  }
  const stack::Image white = testing::RandomImage(2, 2, stack::PixelFormat::kGrey8, 4);
  EXPECT_EQ(stack::ToGrey(white).bytes, white.bytes);
  // Grey stays what it is through three equal channels.
  for (int level = 0; level < 256; ++level) {
    stack::Image flat;
    flat.format = stack::PixelFormat::kRgb8;
    flat.width = flat.height = 1;
    flat.stride = 3;
    flat.bytes = std::make_shared<const std::vector<std::uint8_t>>(3, static_cast<std::uint8_t>(level));
    EXPECT_EQ(stack::ToGrey(flat).Row(0)[0], level);
  }
}

TEST(LoadDepth, ScalesToMillimetres) {
  const TemporaryFolder folder("depth");
  const std::filesystem::path file = folder.path() / "d.png";
  std::ofstream(file, std::ios::binary) << EncodePng16(3, 2, {0, 65535, 5000, 5002, 5003, 65534});
  stack::CameraCalibration camera;
  camera.intrinsics.width = 3;
  camera.intrinsics.height = 2;
  const ImageFile image{base::Time{} + base::Seconds(2.5), file};
  const stack::DepthImage tum = LoadDepth(image, camera, 5000);
  EXPECT_EQ(*tum.millimetres, (std::vector<std::uint16_t>{0, 0, 1000, 1000, 1001, 13107}));
  EXPECT_EQ(tum.exposure_start, image.captured);
  EXPECT_EQ(*LoadDepth(image, camera, 1000).millimetres, (std::vector<std::uint16_t>{0, 0, 5000, 5002, 5003, 65534}));
  EXPECT_EQ((*LoadDepth(image, camera, 100).millimetres)[2], 50'000);
  EXPECT_EQ((*LoadDepth(image, camera, 100).millimetres)[5], 0);  // 655 m
  camera.intrinsics.width = 4;
  EXPECT_NE(Complaint([&] { LoadDepth(image, camera, 1000); }).find("is 3x2 pixels"), std::string::npos);
  std::ofstream(file, std::ios::binary) << EncodePng(testing::RandomImage(3, 2, stack::PixelFormat::kRgb8, 1));
  EXPECT_NE(Complaint([&] { LoadDepth(image, camera, 1000); }).find("3 channels of 8 bits"), std::string::npos);
}

}  // namespace
}  // namespace alula::scenarios::dataset
