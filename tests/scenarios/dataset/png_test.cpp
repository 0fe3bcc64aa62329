#include "scenarios/dataset/png.h"

#include <gtest/gtest.h>

#include "tests/scenarios/dataset/synthetic.h"

namespace alula::scenarios::dataset {
namespace {

using testing::Complaint;

TEST(Png, PixelsComeBackAsTheyWere) {
  for (const stack::PixelFormat format : {stack::PixelFormat::kGrey8, stack::PixelFormat::kRgb8}) {
    for (const int width : {1, 7, 640}) {
      const stack::Image image = testing::RandomImage(width, 5, format, 3);
      const PngImage back = DecodePng(EncodePng(image), "x.png");
      EXPECT_EQ(back.width, width);
      EXPECT_EQ(back.height, 5);
      EXPECT_EQ(back.depth, 8);
      EXPECT_EQ(back.bytes, testing::Pixels(image));
      EXPECT_EQ(testing::Pixels(ToImage(back, "x.png")), testing::Pixels(image));
    }
  }
}

TEST(Png, DepthKeepsSixteenBits) {
  std::vector<std::uint16_t> values;
  for (int i = 0; i < 300; ++i) values.push_back(static_cast<std::uint16_t>(i * 218));
  const PngImage back = DecodePng(EncodePng16(30, 10, values), "d.png");
  ASSERT_EQ(back.depth, 16);
  ASSERT_EQ(back.bytes.size(), 600u);
  EXPECT_EQ(std::vector<std::uint16_t>(reinterpret_cast<const std::uint16_t*>(back.bytes.data()),
                                       reinterpret_cast<const std::uint16_t*>(back.bytes.data()) + 300),
            values);
  EXPECT_NE(Complaint([&] { ToImage(back, "d.png"); }), "");
}

TEST(Png, BrokenFilesAreBadInput) {
  const std::string good = EncodePng(testing::RandomImage(33, 9, stack::PixelFormat::kRgb8, 1));
  for (std::size_t size = 0; size < good.size(); size += 7) {
    EXPECT_NE(Complaint([&] { DecodePng(std::string_view(good).substr(0, size), "x.png"); }), "") << size;
  }
  EXPECT_NE(Complaint([] { ReadPng("/nowhere.png"); }), "");
  EXPECT_NE(Complaint([] { ReadPng("/"); }), "");
  // 2³⁰ pixels in the header, none behind it.
  std::string huge = good;
  huge[18] = huge[22] = '\x7f';
  EXPECT_NE(Complaint([&] { DecodePng(huge, "x.png"); }), "");
}

TEST(Png, MutationsEndInBadInputOrAnImage) {
  base::RandomStream random(1, "png");
  const std::string grey = EncodePng(testing::RandomImage(13, 9, stack::PixelFormat::kGrey8, 1));
  const std::string deep = EncodePng16(5, 5, std::vector<std::uint16_t>(25, 700));
  for (int i = 0; i < 4000; ++i) {
    std::string bytes = random.Index(2) == 0 ? grey : deep;
    for (std::uint64_t k = 1 + random.Index(4); k > 0; --k) {
      bytes[random.Index(bytes.size())] = static_cast<char>(random.Bits());
    }
    Complaint([&] {
      const PngImage image = DecodePng(bytes, "x.png");
      EXPECT_EQ(image.bytes.size(),
                static_cast<std::size_t>(image.width * image.height * image.channels * image.depth / 8));
    });
  }
}

}  // namespace
}  // namespace alula::scenarios::dataset
