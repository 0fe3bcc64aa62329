#include "stack/slam/map_file.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "base/random.h"

namespace alula::stack::slam {
namespace {

using base::Transform;
using base::Vec3;

/// Two parts of three and two keyframes, with one keyframe and one landmark dropped in between.
Map SomeMap() {
  base::RandomStream random(1, "test/map_file");
  const auto vector = [&random] { return Vec3(random.Gaussian(), random.Gaussian(), random.Gaussian()); };
  Map map;
  map.eyes.X_BL = {base::Exp(vector()), vector()};
  map.eyes.X_LR = Transform{base::Exp(0.01 * vector()), Vec3(0.11, 0, 0)};
  map.anchors = {0, 4};
  for (int i = 0; i < 6; ++i) {
    auto k = std::make_unique<Keyframe>();
    k->id = i;
    k->part = i < 4 ? 0 : 1;
    k->seq = static_cast<std::uint32_t>(10 * i);
    k->stamp = base::Time{1'000'000'000LL * i};
    k->X_OB = {base::Exp(vector()), vector()};
    k->X_MB = {base::Exp(vector()), vector()};
    k->up_B.reset();
    if (i != 3) k->up_B = vector().normalized();  // one knows no vertical
    for (int f = 0; f < 5; ++f) {
      PlacePoint point;
      point.pixel = vector().head<2>();
      point.normalised = vector().head<2>();
      point.descriptor = {random.Bits(), random.Bits(), random.Bits(), random.Bits()};
      if (f % 2 == 0) point.p_C = vector();
      k->view.points.push_back(point);
      k->right.emplace_back();
      if (f % 2 == 0) k->right.back() = vector().head<2>();
    }
    k->view.lines.emplace_back().ends_C = {vector(), vector()};
    k->view.focal = 458.0;
    if (i % 2 == 0) k->view.up_C = vector();
    k->landmarks.assign(5, -1);
    if (i > 0 && i != 4) {
      k->previous = i - 1;
      k->from_previous = RelativeMotion{0, 0, {base::Exp(vector()), vector()}, base::Vec6::Constant(0.01)};
    }
    map.keyframes.push_back(std::move(k));
  }
  for (int l = 0; l < 4; ++l) {
    AddLandmark(map, 0, l, vector());
    AddSight(map, l, 2, l);
  }
  AddSight(map, 3, 1, 0);
  AddLandmark(map, 4, 2, vector());
  RemoveLandmark(map, 1);
  RemoveSight(map, 3, 1);
  map.keyframe(2).previous = 0;
  map.keyframes[1].reset();
  return map;
}

TEST(MapFile, ComesBackAsItWasWithoutGaps) {
  const Map map = SomeMap();
  const std::vector<std::uint8_t> bytes = ToBytes(map);
  const Map read = MapFromBytes(bytes, "test");
  ASSERT_EQ(read.keyframes.size(), 5U);
  ASSERT_EQ(read.landmarks.size(), 4U);
  EXPECT_EQ(read.anchors, (std::vector<int>{0, 3}));
  const Keyframe &was = map.keyframe(2), &is = read.keyframe(1);
  EXPECT_EQ(is.id, 1);
  EXPECT_EQ(is.previous, 0);
  EXPECT_EQ(is.stamp, was.stamp);
  EXPECT_EQ(is.X_MB.p, was.X_MB.p);
  EXPECT_EQ(is.X_MB.q.coeffs(), was.X_MB.q.coeffs());
  EXPECT_EQ(is.view.points[3].descriptor, was.view.points[3].descriptor);
  EXPECT_EQ(is.view.points[2].p_C, was.view.points[2].p_C);
  EXPECT_EQ(is.right[1].has_value(), was.right[1].has_value());
  EXPECT_EQ(is.view.lines[0].ends_C, was.view.lines[0].ends_C);
  EXPECT_EQ(is.up_B, was.up_B);
  EXPECT_FALSE(read.keyframe(2).up_B);
  EXPECT_EQ(is.landmarks, (std::vector<int>{0, -1, 1, 2, -1}));
  EXPECT_EQ(read.landmark(2).p_M, map.landmark(3).p_M);
  EXPECT_EQ(read.landmark(3).part, 1);
  EXPECT_EQ(ToBytes(read), bytes);
}

TEST(MapFile, WhatIsBrokenIsRefused) {
  const std::vector<std::uint8_t> whole = ToBytes(SomeMap());
  EXPECT_THROW(MapFromBytes({}, "test"), base::InputError);
  for (std::size_t size = 0; size < whole.size(); size += 7) {
    EXPECT_THROW(MapFromBytes(std::span(whole).first(size), "test"), base::InputError) << size;
  }
  std::vector<std::uint8_t> longer = whole;
  longer.push_back(0);
  EXPECT_THROW(MapFromBytes(longer, "test"), base::InputError);
  std::vector<std::uint8_t> other = whole;
  other[8] = 99;  // the version
  EXPECT_THROW(MapFromBytes(other, "test"), base::InputError);
  // Bits that flip: refused, or a map whose links hold.
  base::RandomStream random(2, "test/map_file");
  int refused = 0;
  for (int i = 0; i < 2000; ++i) {
    std::vector<std::uint8_t> flipped = whole;
    flipped[random.Bits() % flipped.size()] ^= static_cast<std::uint8_t>(1U << (random.Bits() % 8));
    try {
      ToBytes(MapFromBytes(flipped, "test"));
    } catch (const base::InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace alula::stack::slam
