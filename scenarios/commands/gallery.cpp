#include <cstdio>

#include "base/error.h"
#include "scenarios/commands/verbs.h"
#include "scenarios/dataset/png.h"
#include "scenarios/gallery/contact_sheet.h"
#include "scenarios/gallery/texture_statistics.h"
#include "scenarios/write_file.h"

namespace alula::scenarios::commands {
namespace {

/// The worlds named, or all of the catalog.
std::vector<CatalogEntry> WorldsOf(const CommandLine& line) {
  std::vector<CatalogEntry> worlds;
  for (const std::string& name : line.names) {
    worlds.push_back(FindAny(name));
    if (worlds.back().kind != "world") {
      throw base::InputError(name + ": is a " + worlds.back().kind + ", no world ('alula list worlds' names them)");
    }
  }
  if (!line.names.empty()) return worlds;
  for (CatalogEntry& entry : ListCatalogs()) {
    if (entry.kind == "world") worlds.push_back(std::move(entry));
  }
  return worlds;
}

stack::Image ImageOf(const gallery::ContactSheet& sheet) {
  stack::Image image;
  image.format = stack::PixelFormat::kRgb8;
  image.width = sheet.width;
  image.height = sheet.height;
  image.stride = 3 * sheet.width;
  image.bytes = std::make_shared<const std::vector<std::uint8_t>>(sheet.rgb);
  return image;
}

}  // namespace

int Gallery(const CommandLine& line) {
  const std::filesystem::path folder = line.out.value_or("gallery");
  const std::uint64_t seed = line.seed.value_or(1);
  for (const CatalogEntry& entry : WorldsOf(line)) {
    const gallery::ContactSheet sheet =
        gallery::MakeContactSheet(LoadWorld(entry.file, line.overrides, seed), entry.name, seed, line.render);
    const std::filesystem::path file = folder / (entry.name + ".png");
    std::filesystem::create_directories(folder);
    WriteFile("--out", file, dataset::EncodePng(ImageOf(sheet)));
    std::printf("%-27s %5zu objects, %7zu triangles, made in %4.0f ms: %s\n", entry.name.c_str(), sheet.objects,
                sheet.triangles, sheet.load_ms, file.c_str());
    std::fflush(stdout);
  }
  return 0;
}

int CheckTextures(const CommandLine& line) {
  std::vector<gallery::TextureRow> rows;
  const std::uint64_t seed = line.seed.value_or(1);
  for (const std::string& folder : line.beside) rows.push_back(gallery::TextureOfFolder(folder));
  for (const CatalogEntry& entry : WorldsOf(line)) {
    rows.push_back(gallery::TextureOfWorld(LoadWorld(entry.file, line.overrides, seed), entry.name, seed, line.pictures,
                                           line.render));
  }
  if (line.json != "-") std::fputs(gallery::ToTable(rows).c_str(), stdout);
  if (!line.json.empty()) WriteFile("--json", line.json, gallery::ToJson(rows));
  return 0;
}

}  // namespace alula::scenarios::commands
