#include "tests/architecture/include_rules.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>

namespace alula::architecture {

namespace {

namespace fs = std::filesystem;

/// One room: which folders it may include from (path prefixes) and which libraries. "*" is everything.
struct Room {
  std::string_view folder;
  std::vector<std::string_view> may_include;
  std::vector<std::string_view> libraries;
};

/// The longest folder that fits a path is its room, so `stack/interface` comes before `stack`.
const std::vector<Room>& Rooms() {
  static const std::vector<Room> rooms = {
      {"base", {"base/"}, {"yaml-cpp"}},
      {"geometry", {"base/", "geometry/"}, {"json", "png"}},
      {"stack/interface", {"base/", "stack/interface/"}, {}},
      {"stack", {"base/", "stack/"}, {"opencv", "ceres", "octomap", "ompl", "nanoflann", "fmt"}},
      {"worlds", {"base/", "geometry/", "worlds/"}, {"fmt"}},
      {"vehicles", {"base/", "geometry/", "stack/interface/", "vehicles/"}, {"fmt"}},
      {"render", {"base/", "geometry/", "worlds/", "stack/interface/", "render/"}, {"gl", "opencv", "fmt"}},
      // sim knows vehicles by their interface only: it names no vehicle type.
      {"sim",
       {"base/", "geometry/", "worlds/", "render/", "stack/interface/", "vehicles/vehicle.h", "sim/"},
       {"bullet", "fmt", "json"}},
      {"scenarios", {"*"}, {"*"}},
      {"bench", {"*"}, {"*"}},
      {"tests", {"*"}, {"*"}},
  };
  return rooms;
}

/// Prefixes of the headers of a library. `hidden`: its types stay behind internal/ headers, so that it can be swapped.
struct Library {
  std::string_view name;
  std::vector<std::string_view> prefixes;
  bool hidden;
};

const std::vector<Library>& Libraries() {
  static const std::vector<Library> libraries = {
      {"yaml-cpp", {"yaml-cpp/"}, true},
      {"png", {"png.h"}, true},
      {"jpeg", {"jpeglib.h"}, true},
      {"bullet", {"bt", "Bullet", "LinearMath/", "bullet/"}, true},
      {"gl", {"GL/", "EGL/", "KHR/", "GLES"}, true},
      {"ceres", {"ceres/"}, true},
      {"octomap", {"octomap/", "octomath/"}, true},
      {"ompl", {"ompl/"}, true},
      {"opencv", {"opencv2/", "opencv4/"}, true},
      {"nanoflann", {"nanoflann"}, false},
      {"fmt", {"fmt/", "spdlog/"}, false},
      {"json", {"nlohmann/"}, false},
      {"cli", {"CLI/"}, true},
      {"sqlite", {"sqlite3.h"}, true},
      {"zlib", {"zlib.h"}, true},
      {"boost", {"boost/"}, true},
  };
  return libraries;
}

bool StartsWithAny(std::string_view text, const std::vector<std::string_view>& prefixes) {
  return std::any_of(prefixes.begin(), prefixes.end(),
                     [text](std::string_view prefix) { return prefix == "*" || text.starts_with(prefix); });
}

const Room* RoomOf(std::string_view path) {
  for (const Room& room : Rooms()) {
    if (path.starts_with(room.folder) && path.substr(room.folder.size()).starts_with("/")) return &room;
  }
  return nullptr;
}

/// "stack/mapping/" of "stack/mapping/internal/x.h".
std::string_view OwnerOfInternal(std::string_view include) {
  const std::size_t at = include.find("/internal/");
  return at == std::string_view::npos ? std::string_view() : include.substr(0, at + 1);
}

/// What is wrong with `path` including `include`; empty when nothing is.
std::string Wrong(const std::string& path, const Room& room, std::string_view include, bool quoted) {
  const std::string folder(room.folder);
  if (quoted) {
    if (RoomOf(include) == nullptr) return "the include root is the repository";
    if (!StartsWithAny(include, room.may_include)) return folder + "/ may not";
    const std::string_view owner = OwnerOfInternal(include);
    const bool looks_inside = folder == "tests" || folder == "bench";  // what is checked or timed is a part's inside
    if (!owner.empty() && !looks_inside && !path.starts_with(owner)) {
      return "internal/ headers belong to " + std::string(owner);
    }
    return {};
  }
  for (const Library& library : Libraries()) {
    if (!StartsWithAny(include, library.prefixes)) continue;
    if (std::none_of(room.libraries.begin(), room.libraries.end(),
                     [&](std::string_view name) { return name == "*" || name == library.name; })) {
      return folder + "/ may not use " + std::string(library.name);
    }
    const bool public_header = path.ends_with(".h") && path.find("/internal/") == std::string::npos;
    if (library.hidden && public_header && folder != "tests") {
      return std::string(library.name) + " headers belong in .cpp files and internal/ headers";
    }
  }
  return {};
}

std::vector<fs::path> Files(const fs::path& root) {
  std::vector<fs::path> files;
  for (const Room& room : Rooms()) {
    if (room.folder.find('/') != std::string_view::npos || !fs::exists(root / room.folder)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(root / room.folder)) {
      const std::string extension = entry.path().extension().string();
      if (extension == ".h" || extension == ".cpp") files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

std::vector<Violation> CheckFile(const std::string& path, std::string_view text) {
  std::vector<Violation> violations;
  const Room* room = RoomOf(path);
  if (room == nullptr) return {{path + ": lies in no room"}};
  std::istringstream lines{std::string(text)};
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    std::size_t at = line.find_first_not_of(" \t");
    if (at == std::string::npos || line[at] != '#') continue;
    at = line.find_first_not_of(" \t", at + 1);
    if (at == std::string::npos || line.compare(at, 7, "include") != 0) continue;
    const std::size_t open = line.find_first_of("<\"", at);
    if (open == std::string::npos) continue;
    const std::size_t close = line.find_first_of(">\"", open + 1);
    const std::string include = line.substr(open + 1, close - open - 1);
    const std::string wrong = Wrong(path, *room, include, line[open] == '"');
    if (!wrong.empty()) {
      violations.push_back({path + ":" + std::to_string(number) + ": includes " + include + "; " + wrong});
    }
  }
  return violations;
}

std::vector<Violation> CheckTree(const fs::path& root) {
  std::vector<Violation> violations;
  for (const fs::path& file : Files(root)) {
    std::ifstream stream(file);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    const auto found = CheckFile(fs::relative(file, root).generic_string(), text);
    violations.insert(violations.end(), found.begin(), found.end());
  }
  return violations;
}

std::size_t CountFiles(const fs::path& root) { return Files(root).size(); }

}  // namespace alula::architecture
