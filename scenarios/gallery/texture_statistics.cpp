#include "scenarios/gallery/texture_statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>

#include "base/error.h"
#include "render/camera_renderer.h"
#include "render/sensor_effects.h"
#include "scenarios/dataset/png.h"
#include "scenarios/factories.h"
#include "scenarios/gallery/viewpoints.h"

namespace alula::scenarios::gallery {
namespace {

constexpr int kWidth = 752;
constexpr int kHeight = 480;
constexpr int kCell = 32;             // px
constexpr double kLineLength = 40.0;  // px
constexpr int kCornerSpacing = 8;     // px

/// Smaller eigenvalue of the mean gradient matrix over 7 × 7 px, (grey level/px)² (Shi and Tomasi 1994).
cv::Mat CornerStrength(const cv::Mat& grey) {
  cv::Mat dx, dy;
  cv::Scharr(grey, dx, CV_32F, 1, 0, 1.0 / 32.0);
  cv::Scharr(grey, dy, CV_32F, 0, 1, 1.0 / 32.0);
  cv::Mat xx = dx.mul(dx), xy = dx.mul(dy), yy = dy.mul(dy);
  for (cv::Mat* m : {&xx, &xy, &yy}) cv::boxFilter(*m, *m, CV_32F, {7, 7});
  cv::Mat half_trace = 0.5 * (xx + yy);
  cv::Mat difference = 0.5 * (xx - yy), root;
  cv::sqrt(difference.mul(difference) + xy.mul(xy), root);
  return half_trace - root;
}

/// The strongest point of each square of kCornerSpacing px that is strong enough.
std::vector<cv::Point> Corners(const cv::Mat& grey) {
  constexpr float kLeast = 16.0F;  // 4² (grey level/px)²
  const cv::Mat strength = CornerStrength(grey);
  std::vector<cv::Point> corners;
  for (int y = 8; y + kCornerSpacing <= grey.rows - 8; y += kCornerSpacing) {
    for (int x = 8; x + kCornerSpacing <= grey.cols - 8; x += kCornerSpacing) {
      double best = 0.0;
      cv::Point at;
      cv::minMaxLoc(strength(cv::Rect(x, y, kCornerSpacing, kCornerSpacing)), nullptr, &best, nullptr, &at);
      if (best >= kLeast) corners.emplace_back(x + at.x, y + at.y);
    }
  }
  return corners;
}

std::vector<cv::Vec4f> Lines(const cv::Mat& grey) {
  std::vector<cv::Vec4f> found;
  cv::createLineSegmentDetector(cv::LSD_REFINE_STD)->detect(grey, found);
  std::erase_if(found, [](const cv::Vec4f& s) { return std::hypot(s[2] - s[0], s[3] - s[1]) < kLineLength; });
  return found;
}

double BareShare(const cv::Size& size, const std::vector<cv::Point>& corners, const std::vector<cv::Vec4f>& lines) {
  cv::Mat taken = cv::Mat::zeros(size.height / kCell, size.width / kCell, CV_8U);
  const auto take = [&taken](double x, double y) {
    const int column = static_cast<int>(x) / kCell;
    const int row = static_cast<int>(y) / kCell;
    if (row >= 0 && row < taken.rows && column >= 0 && column < taken.cols) taken.at<std::uint8_t>(row, column) = 1;
  };
  for (const cv::Point& c : corners) take(c.x, c.y);
  for (const cv::Vec4f& s : lines) {
    const int steps = static_cast<int>(std::hypot(s[2] - s[0], s[3] - s[1]) / 4.0) + 1;
    for (int i = 0; i <= steps; ++i) {
      const double t = static_cast<double>(i) / steps;
      take(s[0] + t * (s[2] - s[0]), s[1] + t * (s[3] - s[1]));
    }
  }
  return 1.0 - static_cast<double>(cv::countNonZero(taken)) / static_cast<double>(taken.total());
}

Spread SpreadOf(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto at = [&values](double share) {
    return values[static_cast<std::size_t>(std::lround(share * static_cast<double>(values.size() - 1)))];
  };
  return {at(0.25), at(0.5), at(0.75)};
}

TextureRow RowOf(const std::string& name, const std::vector<PictureTexture>& pictures) {
  const auto spread = [&pictures](double PictureTexture::*field) {
    std::vector<double> values;
    for (const PictureTexture& p : pictures) values.push_back(p.*field);
    return SpreadOf(std::move(values));
  };
  return {name,
          pictures.size(),
          spread(&PictureTexture::corners),
          spread(&PictureTexture::lines),
          spread(&PictureTexture::bare),
          spread(&PictureTexture::mean),
          spread(&PictureTexture::contrast)};
}

/// Grey values of an 8- or 16-bit PNG, by luma where it has colour.
std::vector<std::uint8_t> GreyOf(const dataset::PngImage& png) {
  const std::size_t bytes = static_cast<std::size_t>(png.depth) / 8;
  const auto value = [&](std::size_t i) { return static_cast<double>(png.bytes[i * bytes + bytes - 1]); };
  std::vector<std::uint8_t> grey(static_cast<std::size_t>(png.width) * static_cast<std::size_t>(png.height));
  for (std::size_t i = 0; i < grey.size(); ++i) {
    const double luma =
        png.channels == 1 ? value(i) : 0.299 * value(3 * i) + 0.587 * value(3 * i + 1) + 0.114 * value(3 * i + 2);
    grey[i] = static_cast<std::uint8_t>(luma + 0.5);
  }
  return grey;
}

}  // namespace

PictureTexture TextureOf(const std::vector<std::uint8_t>& bytes, int width, int height) {
  const cv::Mat grey(height, width, CV_8UC1, const_cast<std::uint8_t*>(bytes.data()));
  const std::vector<cv::Point> corners = Corners(grey);
  const std::vector<cv::Vec4f> lines = Lines(grey);
  cv::Scalar mean, deviation;
  cv::meanStdDev(grey, mean, deviation);
  const double area = static_cast<double>(kWidth) * kHeight / (static_cast<double>(width) * height);
  return {static_cast<double>(corners.size()) * area, static_cast<double>(lines.size()) * std::sqrt(area),
          BareShare(grey.size(), corners, lines), mean[0], deviation[0]};
}

TextureRow TextureOfWorld(const WorldConfig& config, const std::string& name, std::uint64_t seed, int count,
                          const std::string& maker) {
  const auto world = MakeWorld(config, seed);
  const auto renderer = render::MakeRendererAtStart(maker, *world, seed);
  std::vector<PictureTexture> pictures;
  render::Picture picture;
  for (const base::Transform& X_WC : RandomViewpoints(*world, count, seed)) {
    render::View view;
    view.X_WC = X_WC;
    view.intrinsics = WideCamera(kWidth, kHeight);
    renderer->Grey(view, picture);
    render::ApplyPixelNoise(picture, pictures.size(), {});
    pictures.push_back(TextureOf(picture.bytes, kWidth, kHeight));
  }
  return RowOf(name, pictures);
}

TextureRow TextureOfFolder(const std::filesystem::path& folder) {
  if (!std::filesystem::is_directory(folder)) throw base::InputError(folder.string() + ": no such folder");
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".png") files.push_back(entry.path());
  }
  if (files.empty()) throw base::InputError(folder.string() + ": holds no PNG file");
  std::sort(files.begin(), files.end());
  std::vector<PictureTexture> pictures;
  for (const auto& file : files) {
    const dataset::PngImage png = dataset::ReadPng(file);
    pictures.push_back(TextureOf(GreyOf(png), png.width, png.height));
  }
  return RowOf(folder.string(), pictures);
}

std::string ToTable(const std::vector<TextureRow>& rows) {
  std::size_t widest = 20;
  for (const TextureRow& row : rows) widest = std::max(widest, row.name.size());
  std::string table = fmt::format("{:<{}}  {:>8}  {:>20}  {:>17}  {:>20}  {:>14}  {:>14}\n", "median (quartiles)",
                                  widest, "pictures", "corners", "lines", "bare share", "mean", "contrast");
  for (const TextureRow& row : rows) {
    const auto cell = [](const Spread& s, int digits) {
      return fmt::format("{:.{}f} ({:.{}f}, {:.{}f})", s.median, digits, s.low, digits, s.high, digits);
    };
    table += fmt::format("{:<{}}  {:>8}  {:>20}  {:>17}  {:>20}  {:>14}  {:>14}\n", row.name, widest, row.pictures,
                         cell(row.corners, 0), cell(row.lines, 0), cell(row.bare, 2), cell(row.mean, 0),
                         cell(row.contrast, 0));
  }
  return table;
}

std::string ToJson(const std::vector<TextureRow>& rows) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const TextureRow& row : rows) {
    const std::string head = "textures/" + row.name + "/";
    json[head + "pictures"] = row.pictures;
    const auto add = [&](const char* what, const Spread& s) {
      json[head + what + "_quartile1"] = s.low;
      json[head + what + "_median"] = s.median;
      json[head + what + "_quartile3"] = s.high;
    };
    add("corners", row.corners);
    add("lines", row.lines);
    add("bare_share", row.bare);
    add("mean_levels", row.mean);
    add("contrast_levels", row.contrast);
  }
  return json.dump(2) + "\n";
}

}  // namespace alula::scenarios::gallery
