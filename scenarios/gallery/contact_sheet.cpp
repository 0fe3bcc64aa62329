#include "scenarios/gallery/contact_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <opencv2/imgproc.hpp>

#include "base/random.h"
#include "render/camera_renderer.h"
#include "scenarios/gallery/viewpoints.h"
#include "scenarios/gallery/world_at_hour.h"

namespace alula::scenarios::gallery {
namespace {

using Hour = worlds::WeatherConfig::Hour;

constexpr int kWidth = 640;  // as drawn
constexpr int kHeight = 480;
constexpr int kTileWidth = 400;  // as shown
constexpr int kTileHeight = 300;
constexpr int kGap = 6;
constexpr int kHeader = 34;
constexpr const char* kColumns[] = {"colour", "grey", "depth", "ids", "colour, night", "infrared, night"};
constexpr int kColumnCount = static_cast<int>(std::size(kColumns));

cv::Mat ToMat(const render::Picture& picture) {
  const cv::Mat raw(picture.height, picture.width, picture.channels == 1 ? CV_8UC1 : CV_8UC3,
                    const_cast<std::uint8_t*>(picture.bytes.data()));
  cv::Mat rgb;
  picture.channels == 1 ? cv::cvtColor(raw, rgb, cv::COLOR_GRAY2RGB) : raw.copyTo(rgb);
  return rgb;
}

/// Near is yellow, far is blue, nothing is black; by the logarithm from 0.5 m to 200 m.
cv::Mat ToMat(const render::DepthPicture& depth) {
  cv::Mat level(depth.height, depth.width, CV_8UC1);
  for (int i = 0; i < depth.width * depth.height; ++i) {
    const double share = std::log(std::max(depth.metres[static_cast<std::size_t>(i)], 0.5F) / 0.5) / std::log(400.0);
    level.data[i] = static_cast<std::uint8_t>(255.0 * (1.0 - std::clamp(share, 0.0, 1.0)));
  }
  cv::Mat bgr, rgb;
  cv::applyColorMap(level, bgr, cv::COLORMAP_VIRIDIS);
  cv::cvtColor(bgr, rgb, cv::COLOR_BGR2RGB);
  for (int i = 0; i < depth.width * depth.height; ++i) {
    if (depth.metres[static_cast<std::size_t>(i)] == 0.0F) std::fill_n(rgb.data + 3 * i, 3, std::uint8_t{0});
  }
  return rgb;
}

/// A colour of its own for each object.
cv::Mat ToMat(const render::SurfacePicture& surface) {
  cv::Mat rgb(surface.height, surface.width, CV_8UC3);
  for (int i = 0; i < surface.width * surface.height; ++i) {
    const std::uint32_t id = surface.instances[static_cast<std::size_t>(i)];
    const auto bits = base::Philox4x32({id, 0, 0, 0}, {7, 7});
    for (int c = 0; c < 3; ++c) {
      rgb.data[3 * i + c] =
          id == 0 ? std::uint8_t{0} : static_cast<std::uint8_t>(60 + bits[static_cast<std::size_t>(c)] % 196);
    }
  }
  return rgb;
}

/// Exposed so that the mean comes to 0.42 of full scale, with at most `most` times the nominal exposure.
render::Picture Exposed(render::CameraRenderer& renderer, render::View view, float most) {
  render::Picture picture;
  for (int i = 0; i < 3; ++i) {
    view.infrared ? renderer.Grey(view, picture) : renderer.Colour(view, picture);
    const double mean = std::accumulate(picture.bytes.begin(), picture.bytes.end(), 0.0) /
                        static_cast<double>(picture.bytes.size()) / 255.0;
    view.brightness = std::clamp(view.brightness * static_cast<float>(0.42 / std::max(mean, 1e-3)), 0.25F, most);
  }
  return picture;
}

/// Lights what the camera sees; 10 shows a texture at its own value at 3 m.
worlds::Lamp Illuminator() {
  worlds::Lamp lamp;
  lamp.cone = 1.0;
  lamp.intensity = 10.0;
  lamp.range = 30.0;
  return lamp;
}

std::vector<cv::Mat> Row(render::CameraRenderer& day, render::CameraRenderer& night, const base::Transform& X_WC) {
  render::View view;
  view.X_WC = X_WC;
  view.intrinsics = WideCamera(kWidth, kHeight);
  std::vector<cv::Mat> tiles;
  render::Picture picture;
  day.Colour(view, picture);
  tiles.push_back(ToMat(picture));
  day.Grey(view, picture);
  tiles.push_back(ToMat(picture));
  render::DepthPicture depth;
  day.Depth(view, depth);
  tiles.push_back(ToMat(depth));
  render::SurfacePicture surface;
  day.Surface(view, surface);
  tiles.push_back(ToMat(surface));
  tiles.push_back(ToMat(Exposed(night, view, 8.0F)));
  view.infrared = true;
  view.lamps = {Illuminator()};
  tiles.push_back(ToMat(Exposed(night, view, 8.0F)));
  return tiles;
}

void Write(cv::Mat& image, const std::string& text, int x, int y) {
  cv::putText(image, text, {x, y}, cv::FONT_HERSHEY_SIMPLEX, 0.5, {0, 0, 0}, 3, cv::LINE_AA);
  cv::putText(image, text, {x, y}, cv::FONT_HERSHEY_SIMPLEX, 0.5, {255, 255, 255}, 1, cv::LINE_AA);
}

std::size_t TrianglesOf(const worlds::World& world) {
  std::size_t count = 0;
  for (const worlds::Object& object : world.objects) {
    count += geometry::Tessellate(object.shape, object.texture_scale).triangles.size();
  }
  for (const worlds::Actor& actor : world.actors) {
    for (const worlds::ActorLink& link : actor.links) {
      count += geometry::Tessellate(link.shape, link.texture_scale).triangles.size();
    }
  }
  return count;
}

}  // namespace

ContactSheet MakeContactSheet(const WorldConfig& config, const std::string& title, std::uint64_t seed,
                              const std::string& maker) {
  const auto begin = std::chrono::steady_clock::now();
  const auto day = WorldAtHour(config, Hour::kDay, seed);
  const auto made = std::chrono::steady_clock::now();
  const auto night = WorldAtHour(config, Hour::kNight, seed);
  const auto day_renderer = render::MakeRendererAtStart(maker, *day, seed);
  const auto night_renderer = render::MakeRendererAtStart(maker, *night, seed);
  const std::vector<Viewpoint> views = NamedViewpoints(*day);

  ContactSheet sheet;
  sheet.load_ms = std::chrono::duration<double, std::milli>(made - begin).count();
  sheet.objects = day->objects.size();
  sheet.triangles = TrianglesOf(*day);
  sheet.width = kColumnCount * (kTileWidth + kGap) - kGap;
  sheet.height = kHeader + static_cast<int>(views.size()) * (kTileHeight + kGap) - kGap;
  cv::Mat canvas(sheet.height, sheet.width, CV_8UC3, cv::Scalar(24, 24, 24));
  for (int column = 0; column < kColumnCount; ++column) {
    Write(canvas, (column == 0 ? fmt::format("{}, seed {}: ", title, seed) : std::string()) + kColumns[column],
          column * (kTileWidth + kGap) + 8, 22);
  }
  for (std::size_t row = 0; row < views.size(); ++row) {
    const int y = kHeader + static_cast<int>(row) * (kTileHeight + kGap);
    const std::vector<cv::Mat> tiles = Row(*day_renderer, *night_renderer, views[row].X_WC);
    for (int column = 0; column < kColumnCount; ++column) {
      cv::Mat place = canvas(cv::Rect(column * (kTileWidth + kGap), y, kTileWidth, kTileHeight));
      cv::resize(tiles[static_cast<std::size_t>(column)], place, place.size(), 0, 0,
                 column == 3 ? cv::INTER_NEAREST : cv::INTER_AREA);
    }
    Write(canvas, views[row].name, 8, y + 20);
  }
  sheet.rgb.assign(canvas.data,
                   canvas.data + 3 * static_cast<std::size_t>(sheet.width) * static_cast<std::size_t>(sheet.height));
  return sheet;
}

}  // namespace alula::scenarios::gallery
