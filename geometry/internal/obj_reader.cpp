#include "geometry/internal/obj_reader.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <string>

#include "base/error.h"
#include "geometry/internal/file_bytes.h"
#include "geometry/internal/triangulate.h"

namespace alula::geometry::internal {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

/// Statements that say nothing about triangles.
constexpr std::string_view kPassedOver[] = {"o",      "g",        "s",        "mg",         "l",        "p",
                                            "mtllib", "usemtl",   "maplib",   "usemap",     "lod",      "bevel",
                                            "vp",     "c_interp", "d_interp", "shadow_obj", "trace_obj"};

/// Words of a text line by line; `\` at its end joins a line to the next.
class Words {
 public:
  explicit Words(std::string_view text) : text_(text) {}

  bool AtEnd() const { return at_ >= text_.size(); }

  /// The next word of this line; empty at its end or at a comment.
  std::string_view Next() {
    while (!AtEnd()) {
      const char c = text_[at_];
      if (c == '\\' && JoinsLines()) {
        at_ = text_.find('\n', at_) + 1;
        BeginLine();
      } else if (c == ' ' || c == '\t' || c == '\r') {
        ++at_;
      } else {
        break;
      }
    }
    word_ = at_;
    if (AtEnd() || text_[at_] == '\n' || text_[at_] == '#') return {};
    while (!AtEnd() && !IsBlank(text_[at_]) && !(text_[at_] == '\\' && JoinsLines())) ++at_;
    return text_.substr(word_, at_ - word_);
  }

  /// Goes on to the next line, whatever is left of this one.
  void NextLine() {
    while (!Next().empty()) {
    }
    const std::size_t end = text_.find('\n', at_);
    at_ = end == std::string_view::npos ? text_.size() : end + 1;
    BeginLine();
  }

  int line() const { return line_; }
  int column() const { return static_cast<int>(word_ - line_start_) + 1; }

 private:
  static bool IsBlank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }
  bool JoinsLines() const {
    const std::string_view rest = text_.substr(at_ + 1, 2);
    return rest.starts_with('\n') || rest == "\r\n";
  }
  void BeginLine() {
    ++line_;
    line_start_ = word_ = at_;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t word_ = 0;  // where the last word began
  std::size_t line_start_ = 0;
  int line_ = 1;
};

class ObjReader {
 public:
  ObjReader(std::string_view text, const std::filesystem::path& file, std::size_t max_triangles)
      : words_(text), file_(file), max_triangles_(max_triangles) {}

  RawMesh Read() {
    for (; !words_.AtEnd(); words_.NextLine()) {
      const std::string_view statement = words_.Next();
      if (statement.empty()) continue;
      if (statement == "v") {
        positions_.push_back({ReadVector(3), std::nullopt, std::nullopt});
        Check(positions_.back());
      } else if (statement == "vn") {
        normals_.push_back(ReadVector(3));
        Check({Vector3f::Zero(), normals_.back(), std::nullopt});
      } else if (statement == "vt") {
        uvs_.push_back(ReadVector(1).head<2>());
        Check({Vector3f::Zero(), std::nullopt, uvs_.back()});
      } else if (statement == "f" || statement == "fo") {
        ReadFace();
      } else if (std::find(std::begin(kPassedOver), std::end(kPassedOver), statement) == std::end(kPassedOver)) {
        Fail("`" + Shown(statement) + "` is no statement of a polygon mesh; export triangles as OBJ text");
      }
    }
    return std::move(raw_);
  }

 private:
  [[noreturn]] void Fail(const std::string& what) const {
    throw base::InputError({file_.generic_string(), words_.line(), words_.column()}, "", what);
  }

  void Check(const RawMesh::Vertex& vertex) const {
    const std::string wrong = WhatIsWrong(vertex);
    if (!wrong.empty()) Fail(wrong);
  }

  /// Up to three numbers of which the first `least` must be there; the others are 0.
  Vector3f ReadVector(int least) {
    Vector3f v = Vector3f::Zero();
    for (int i = 0; i < 3; ++i) {
      std::string_view word = words_.Next();
      if (word.empty() && i >= least) break;
      if (word.empty()) Fail("the line ends too soon; " + std::to_string(least) + " numbers are wanted");
      if (word.front() == '+') word.remove_prefix(1);
      double value = 0.0;
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
      if (error != std::errc() || end != word.data() + word.size()) Fail("`" + Shown(word) + "` is no number");
      v[i] = ToFloat(value);
    }
    return v;
  }

  /// One index of a corner's "v/vt/vn", from 0; −1 where it is left out. Negative ones count back from the last.
  int ReadIndex(std::string_view& corner, std::size_t count, const char* of) const {
    const std::string_view part = corner.substr(0, corner.find('/'));
    corner.remove_prefix(std::min(corner.size(), part.size() + 1));
    if (part.empty()) return -1;
    long long index = 0;
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), index);
    if (error != std::errc() || end != part.data() + part.size()) Fail("`" + Shown(part) + "` is no index");
    const auto last = static_cast<long long>(count);
    if (index == 0 || index > last || index < -last) {
      Fail("there is no " + std::string(of) + " " + std::to_string(index) + "; " + std::to_string(count) +
           " stand above");
    }
    return static_cast<int>(index > 0 ? index - 1 : last + index);
  }

  /// The vertex of a corner "v", "v/vt", "v//vn" or "v/vt/vn"; corners that say the same share one.
  std::uint32_t ReadCorner(std::string_view corner) {
    std::array<int, 3> key{};
    key[0] = ReadIndex(corner, positions_.size(), "vertex");
    key[1] = ReadIndex(corner, uvs_.size(), "texture coordinate");
    key[2] = ReadIndex(corner, normals_.size(), "normal");
    if (key[0] < 0) Fail("a corner without a vertex; write v, v/vt, v//vn or v/vt/vn");
    if (!corner.empty()) Fail("a corner has at most three indices");
    const auto [known, is_new] = vertices_.try_emplace(key, static_cast<std::uint32_t>(raw_.vertices.size()));
    if (is_new) {
      RawMesh::Vertex vertex = positions_[static_cast<std::size_t>(key[0])];
      if (key[1] >= 0) vertex.uv = uvs_[static_cast<std::size_t>(key[1])];
      if (key[2] >= 0) vertex.normal = normals_[static_cast<std::size_t>(key[2])];
      raw_.vertices.push_back(vertex);
    }
    return known->second;
  }

  void ReadFace() {
    std::vector<std::uint32_t> corners;
    for (std::string_view word = words_.Next(); !word.empty(); word = words_.Next()) {
      corners.push_back(ReadCorner(word));
      if (corners.size() > 2) CheckTriangles(raw_.triangles.size() + corners.size() - 2, max_triangles_, file_);
    }
    if (corners.size() < 3) Fail("a face has " + std::to_string(corners.size()) + " corners; three or more are wanted");
    std::vector<Vector3f> outline;
    outline.reserve(corners.size());
    for (const std::uint32_t i : corners) outline.push_back(raw_.vertices[i].position);
    const auto triangles = Triangulate(outline);
    if (triangles.empty()) Fail("the face's outline crosses itself or is too long; export triangles");
    for (const auto& t : triangles) raw_.triangles.push_back({corners[t[0]], corners[t[1]], corners[t[2]]});
  }

  Words words_;
  const std::filesystem::path& file_;
  std::size_t max_triangles_;
  std::vector<RawMesh::Vertex> positions_;  // without normal and texture coordinate
  std::vector<Vector3f> normals_;
  std::vector<Vector2f> uvs_;
  std::map<std::array<int, 3>, std::uint32_t> vertices_;  // of the corners so far
  RawMesh raw_;
};

}  // namespace

RawMesh ReadObj(std::string_view text, const std::filesystem::path& file, std::size_t max_triangles) {
  return ObjReader(text, file, max_triangles).Read();
}

}  // namespace alula::geometry::internal
