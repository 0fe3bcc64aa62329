#include "sim/sensors/optics.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "base/hash.h"

namespace alula::sim {
namespace {

/// Keys the noise of one frame.
std::uint64_t KeyOf(std::uint64_t seed, std::string_view name, std::uint32_t seq) {
  base::RollingHash key;
  key.Add(seed);
  key.Add(name);
  key.Add(std::uint64_t{seq});
  return key.value();
}

/// What exposure and gain make of the light that the nominal exposure is set for.
double Brightness(const Optics& optics, const ExposureSetting& setting) {
  return setting.length.Seconds() * setting.gain / optics.config.exposure.Seconds();
}

/// Rows of one of the lens's sources, as a camera at X_WC draws it: the source with a lower image and its centre moved.
render::View SourceView(const Optics& optics, const render::Lens::Source& source, const render::Lens::Rows& rows,
                        const base::Transform& X_WC) {
  render::View view{.X_WC = X_WC * base::Transform{source.q_CS, base::Vec3::Zero()},
                    .intrinsics = source.intrinsics,
                    .draw_movers = optics.config.sees_vehicle};
  view.intrinsics.height = rows.count;
  view.intrinsics.cy -= rows.first;
  view.infrared = optics.config.kind == stack::CameraKind::kInfrared;
  for (worlds::Lamp lamp : optics.config.lamps) {
    lamp.position = source.q_CS.conjugate() * lamp.position;
    lamp.direction = source.q_CS.conjugate() * lamp.direction;
    view.lamps.push_back(lamp);
  }
  return view;
}

void Draw(const Optics& optics, const render::View& view, render::CameraRenderer& renderer, render::Picture& out) {
  if (optics.config.kind == stack::CameraKind::kColour) {
    renderer.Colour(view, out);
  } else {
    renderer.Grey(view, out);
  }
}

/// The mean of the pictures at the instants, rounded to nearest.
void DrawMean(const Optics& optics, const render::Lens::Source& source, const render::Lens::Rows& rows,
              const std::vector<Instant>& instants, double brightness, render::CameraRenderer& renderer,
              render::Picture& out) {
  std::vector<std::uint32_t> sums;
  const auto count = static_cast<std::uint32_t>(instants.size());
  for (const Instant& at : instants) {
    PlaceMovers(optics.X_BP, at, renderer);
    render::View view = SourceView(optics, source, rows, at.X_WC);
    view.brightness = static_cast<float>(brightness);
    Draw(optics, view, renderer, out);
    if (count == 1) return;
    sums.resize(out.bytes.size(), count / 2);
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += out.bytes[i];
  }
  for (std::size_t i = 0; i < sums.size(); ++i) out.bytes[i] = static_cast<std::uint8_t>(sums[i] / count);
}

render::Picture DrawExposure(const Optics& optics, const Exposure& exposure, render::CameraRenderer& renderer) {
  const render::Lens& lens = *optics.lens;
  const double brightness = Brightness(optics, exposure.setting);
  render::Picture picture{
      optics.intrinsics.width, optics.intrinsics.height, optics.config.kind == stack::CameraKind::kColour ? 3 : 1, {}};
  const auto channels = static_cast<std::size_t>(picture.channels);
  const std::size_t row_bytes = channels * static_cast<std::size_t>(picture.width);
  picture.bytes.resize(row_bytes * static_cast<std::size_t>(picture.height));
  std::vector<std::uint8_t> canvas(channels * lens.canvas_pixels());
  render::Picture drawn;
  for (const Exposure::Slice& slice : exposure.slices) {
    const render::Lens::Rows rows{slice.first_row, slice.rows};
    for (std::size_t i = 0; i < lens.sources().size(); ++i) {
      const render::Lens::Source& source = lens.sources()[i];
      const render::Lens::Rows needed = lens.RowsOf(i, rows);
      if (needed.count == 0) continue;
      DrawMean(optics, source, needed, slice.instants, brightness, renderer, drawn);
      const std::size_t first_pixel = source.first_pixel + static_cast<std::size_t>(needed.first) *
                                                               static_cast<std::size_t>(source.intrinsics.width);
      std::copy(drawn.bytes.begin(), drawn.bytes.end(),
                canvas.begin() + static_cast<std::ptrdiff_t>(channels * first_pixel));
    }
    lens.Sample(canvas.data(), picture.channels, rows,
                picture.bytes.data() + row_bytes * static_cast<std::size_t>(slice.first_row));
  }
  return picture;
}

const Instant& MiddleOf(const Exposure& exposure) {
  const Exposure::Slice& slice = exposure.slices[exposure.slices.size() / 2];
  return slice.instants[slice.instants.size() / 2];
}

/// The sun, where it may blind the lens, with the share of its disc (and of the haze about it: 2°) that nothing hides.
std::vector<render::GlareLight> SunInView(const Optics& optics, const base::Transform& X_WC,
                                          render::CameraRenderer& renderer) {
  const worlds::Light& light = optics.light;
  const render::Glare& glare = optics.config.glare;
  if (!(glare.veil > 0.0) || !(light.sun > 0.0F)) return {};
  const base::Vec3 to_sun_C = X_WC.q.conjugate() * light.to_sun_W.normalized();
  if (to_sun_C.z() < std::cos(glare.reach)) return {};
  constexpr int kSide = 9;
  constexpr double kFocal = kSide / 0.035;  // px: 2° across
  const base::Quat q_WS = X_WC.q * base::Quat::FromTwoVectors(base::Vec3::UnitZ(), to_sun_C);
  const render::View towards{.X_WC = {q_WS, X_WC.p},
                             .intrinsics = {kSide, kSide, kFocal, kFocal, kSide / 2, kSide / 2, {}},
                             .draw_movers = optics.config.sees_vehicle};
  render::DepthPicture depth;
  renderer.Depth(towards, depth);
  const auto open = std::count(depth.metres.begin(), depth.metres.end(), 0.0F);
  if (open == 0) return {};
  return {{to_sun_C, static_cast<double>(open) / (kSide * kSide)}};
}

/// Pixels that show glass, one byte each; empty where the world has none.
std::vector<std::uint8_t> GlassIn(const render::View& view, render::CameraRenderer& renderer) {
  if (!renderer.Has(worlds::SemanticClass::kGlass)) return {};
  render::SurfacePicture surface;
  renderer.Surface(view, surface);
  std::vector<std::uint8_t> glass;
  glass.reserve(surface.classes.size());
  for (const worlds::SemanticClass c : surface.classes) glass.push_back(c == worlds::SemanticClass::kGlass ? 1 : 0);
  return glass;
}

}  // namespace

Optics MakeOptics(const CameraConfig& config, const stack::CameraIntrinsics& intrinsics,
                  std::shared_ptr<const render::Lens> lens, std::string name, std::uint64_t seed,
                  std::vector<base::Transform> X_BP, const worlds::Light& light) {
  if (!lens) lens = std::make_shared<const render::Lens>(intrinsics);
  base::RollingHash key;
  key.Add(seed);
  key.Add(std::string_view(name));
  const int channels = config.kind == stack::CameraKind::kColour ? 3 : 1;
  auto sensor = std::make_shared<const render::ImageSensor>(config, intrinsics, channels, key.value());
  return {config, intrinsics, std::move(lens), std::move(name), seed, std::move(X_BP), std::move(sensor), light};
}

void PlaceMovers(const std::vector<base::Transform>& X_BP, const Instant& at, render::CameraRenderer& renderer) {
  if (X_BP.empty() && at.X_WL.empty()) return;
  std::vector<base::Transform> X_WM;
  X_WM.reserve(X_BP.size() + at.X_WL.size());
  for (const base::Transform& part : X_BP) X_WM.push_back(at.X_WB * part);
  X_WM.insert(X_WM.end(), at.X_WL.begin(), at.X_WL.end());
  renderer.PlaceMovers(X_WM);
}

stack::DepthImage TakeDepth(const DepthOptics& optics, const Exposure& exposure, render::CameraRenderer& renderer) {
  const render::View view{
      .X_WC = MiddleOf(exposure).X_WC * optics.X_CD, .intrinsics = optics.intrinsics, .draw_movers = false};
  PlaceMovers(optics.X_BP, MiddleOf(exposure), renderer);
  render::DepthPicture depth;
  render::Picture ambient;
  renderer.Depth(view, depth);
  const bool may_drown = optics.config.light.blinding <= 1.0;
  if (may_drown) renderer.Grey(view, ambient);
  const std::vector<std::uint8_t> glass = GlassIn(view, renderer);
  stack::DepthImage image;
  std::vector<std::uint16_t> millimetres = render::MeasureDepth(
      depth, optics.intrinsics.fx, may_drown ? &ambient : nullptr, glass.empty() ? nullptr : &glass,
      optics.config.light, KeyOf(optics.seed, optics.name, exposure.seq));
  const stack::CameraIntrinsics& seen = optics.registered ? *optics.registered : optics.intrinsics;
  if (optics.registered) {
    millimetres = render::RegisterDepth(millimetres, optics.intrinsics, *optics.registered, optics.X_CD);
  }
  image.width = seen.width;
  image.height = seen.height;
  image.exposure_start = exposure.captured + base::Nanoseconds(-exposure.setting.length.ns / 2);
  image.exposure = exposure.setting.length;
  image.millimetres = std::make_shared<const std::vector<std::uint16_t>>(std::move(millimetres));
  return image;
}

stack::Image TakeImage(const Optics& optics, const Exposure& exposure, render::CameraRenderer& renderer) {
  render::Picture picture = DrawExposure(optics, exposure, renderer);
  const std::vector<render::GlareLight> lights = SunInView(optics, MiddleOf(exposure).X_WC, renderer);
  const double brightness = Brightness(optics, exposure.setting);
  optics.sensor->Apply(picture, KeyOf(optics.seed, optics.name, exposure.seq),
                       {.gain = exposure.setting.gain, .brightness = brightness, .lights = lights});

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
