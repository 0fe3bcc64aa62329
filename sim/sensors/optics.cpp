#include "sim/sensors/optics.h"

#include <memory>
#include <utility>

#include "base/hash.h"

namespace alula::sim {
namespace {

/// What exposure and gain make of the light that the nominal exposure is set for.
double Brightness(const Optics& optics, const ExposureSetting& setting) {
  return setting.length.Seconds() * setting.gain / optics.config.exposure.Seconds();
}

/// A band of rows of one picture: the camera with a lower image and its centre moved.
render::View BandView(const Optics& optics, const Exposure::Slice& slice, const base::Transform& X_WC,
                      double brightness) {
  render::View view{.X_WC = X_WC,
                    .intrinsics = optics.intrinsics,
                    .draw_movers = optics.config.sees_vehicle,
                    .brightness = static_cast<float>(brightness)};
  view.intrinsics.height = slice.rows;
  view.intrinsics.cy -= slice.first_row;
  return view;
}

void Draw(const Optics& optics, const render::View& view, render::CameraRenderer& renderer, render::Picture& out) {
  if (optics.config.kind == stack::CameraKind::kColour) {
    renderer.Colour(view, out);
  } else {
    renderer.Grey(view, out);
  }
}

/// The mean of the pictures at the slice's instants, rounded to nearest.
void DrawSlice(const Optics& optics, const Exposure::Slice& slice, double brightness, render::CameraRenderer& renderer,
               render::Picture& out) {
  render::Picture instant;
  std::vector<std::uint32_t> sums;
  const auto count = static_cast<std::uint32_t>(slice.instants.size());
  for (const Instant& at : slice.instants) {
    PlaceVehicle(optics, at.X_WB, renderer);
    Draw(optics, BandView(optics, slice, at.X_WC, brightness), renderer, count == 1 ? out : instant);
    if (count == 1) return;
    sums.resize(instant.bytes.size(), count / 2);
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += instant.bytes[i];
  }
  out = std::move(instant);
  for (std::size_t i = 0; i < sums.size(); ++i) out.bytes[i] = static_cast<std::uint8_t>(sums[i] / count);
}

render::Picture DrawExposure(const Optics& optics, const Exposure& exposure, render::CameraRenderer& renderer) {
  const double brightness = Brightness(optics, exposure.setting);
  render::Picture picture;
  if (exposure.slices.size() == 1) {
    DrawSlice(optics, exposure.slices.front(), brightness, renderer, picture);
    return picture;
  }
  render::Picture band;
  for (const Exposure::Slice& slice : exposure.slices) {
    DrawSlice(optics, slice, brightness, renderer, band);
    picture.bytes.insert(picture.bytes.end(), band.bytes.begin(), band.bytes.end());
  }
  picture.width = band.width;
  picture.height = optics.intrinsics.height;
  picture.channels = band.channels;
  return picture;
}

}  // namespace

void PlaceVehicle(const Optics& optics, const base::Transform& X_WB, render::CameraRenderer& renderer) {
  if (optics.X_BP.empty()) return;
  std::vector<base::Transform> X_WP;
  for (const base::Transform& X_BP : optics.X_BP) X_WP.push_back(X_WB * X_BP);
  renderer.PlaceMovers(X_WP);
}

stack::Image TakeImage(const Optics& optics, const Exposure& exposure, render::CameraRenderer& renderer) {
  render::Picture picture = DrawExposure(optics, exposure, renderer);
  base::RollingHash key;
  key.Add(optics.seed);
  key.Add(std::string_view(optics.name));
  key.Add(std::uint64_t{exposure.seq});
  render::ApplyPixelNoise(picture, key.value(), optics.config.noise);

  stack::Image image;
  image.format = picture.channels == 1 ? stack::PixelFormat::kGrey8 : stack::PixelFormat::kRgb8;
  image.width = picture.width;
  image.height = picture.height;
  image.stride = picture.width * picture.channels;
  image.exposure_start = exposure.captured + base::Nanoseconds(-exposure.setting.length.ns / 2);
  image.exposure = exposure.setting.length;
  image.gain = exposure.setting.gain;
  image.bytes = std::make_shared<const std::vector<std::uint8_t>>(std::move(picture.bytes));
  return image;
}

}  // namespace alula::sim
