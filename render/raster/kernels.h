#pragma once

#include <cstdint>

namespace alula::render::raster {

inline constexpr int kTile = 8;            // px a side; the kernels work on eight lanes
inline constexpr int kSubPixelBits = 8;    // vertices are snapped to 1/256 px
inline constexpr float kGuard = 16384.0F;  // px; vertices farther out are clipped first
/// Floats a vertex: 1; u, v (texels of level 0); light in shadow, what the sun adds; place in the shadow map (texels
/// from the first one's centre, twice; 1/65535 of its depth).
inline constexpr int kAttributes = 8;
inline constexpr std::int32_t kNearer = 1;  // flag of a vertex nearer than the near plane
inline constexpr std::int32_t kBeyond = 2;  // flag of a vertex beyond the guard band

inline constexpr std::int32_t kFlagged = INT32_MIN;

/// Places of vertices, m; padded by seven.
struct Positions {
  const float* x;
  const float* y;
  const float* z;
};

/// Vertices as a view sees them; arrays of one length. A run of them may be written up to the next multiple of eight.
struct Vertices {
  float* row;             // m·px: row / depth is the place in the picture
  float* column;          // likewise
  float* depth;           // m, along the optical axis
  float* inverse_depth;   // 1/m
  std::int32_t* pixel_x;  // 1/256 px; pixel centres are whole pixels; kFlagged where flags are set
  std::int32_t* pixel_y;
  std::int32_t* flags;
};

/// What is nearest at each pixel: tiles of 8×8, rows of tiles from the top; in a tile rows of 8.
struct Target {
  int width;
  int height;
  int tiles_x;
  int tiles_y;
  float* inverse_depth;    // 1/m, larger is nearer
  std::uint32_t* ids;      // place in the list of drawn triangles + 1; 0: nothing; null where nobody asks
  float* tile_farthest;    // a lower bound of inverse_depth for each tile
  std::int32_t* tile_age;  // changes since that bound was made
};

/// Triangles that a picture has drawn: short beside the scene, so that what belongs to them stays in the caches.
struct DrawnList {
  std::uint32_t* numbers;  // in the scene; room for all of its triangles
  std::uint32_t count;
};

/// Triangles of one batch, drawn in their order.
struct DrawJob {
  const std::uint32_t* corners[3];  // first, second and third corners of all triangles, padded by seven
  std::uint32_t first;              // triangle
  std::uint32_t count;
  Vertices vertices;
  Target target;
  DrawnList* drawn;        // appended to
  std::uint32_t* to_clip;  // out: numbers of the triangles that are left to the caller; room for `count`
};

/// A triangle in the picture, and 1/depth = plane[0] + plane[1]·x + plane[2]·y on it, held within [low, high].
struct ScreenTriangle {
  std::int32_t x[3];  // 1/256 px, turning so that the edge functions are positive inside
  std::int32_t y[3];
  double plane[3];
  float low;
  float high;
  std::uint32_t id;
};

/// A mip chain as words of 16 bits: texel (x, y) in the low byte and (x, y + 1) in the high one, so that the four
/// texels of a bilinear sample are 32 bits that follow each other. Rows of all levels have one pitch; level l lies
/// right of the finer ones, from column skip − (skip >> l) + 2 l on, its first column once more behind its last.
struct alignas(32) TextureView {
  std::int32_t offset;       // of the first word
  std::int32_t pitch;        // words
  std::int32_t last_column;  // texels of level 0 less one: all ones
  std::int32_t last_row;
  std::int32_t skip;  // twice the width of level 0
  float last_level;
  std::int32_t unused[2];
};

/// Holes of a triangle: 1, u, v (texels of level 0) over depth as planes over the picture, about (reference_x,
/// reference_y), and the alpha that they look up.
struct HolePlanes {
  float at[3];
  float by_x[3];
  float by_y[3];
  float reference_x;  // px
  float reference_y;
  TextureView texture;
  const std::uint16_t* words;
};

/// Attributes over depth as planes over the picture, relative to a pixel that the triangle covers.
struct alignas(64) TrianglePlanes {
  float at[kAttributes];
  float by_x[kAttributes];
  float by_y[kAttributes];
  float reference_x;  // px
  float reference_y;
  std::uint32_t frame;  // that they were made for
  std::uint32_t texture;
  std::uint32_t sunny;      // the sun adds light somewhere on it, as far as the shadow map must say
  std::uint32_t shadowing;  // as ShadeJob's of the triangle
  std::uint32_t unused[2];
};

/// What looks into the statics' shadow map would give: light, none, or a look is needed.
enum class Shadowing : std::uint8_t { kMixed, kLit, kDark };
inline constexpr std::uint32_t kFirstShadowingGrid = 3;  // as a triangle's shadowing: numbers of grids begin here

/// By block of the shadow map, for a triangle that is neither lit nor dark all over: rows of columns from texel
/// (x0, y0) on.
struct ShadowingGrid {
  std::int32_t x0, y0, columns, rows;
  std::uint32_t first;  // place in the list of all blocks
};
inline constexpr int kShadowingBlock = 4;  // texels

/// Texels of the shadow map, inclusive, where movers cast theirs.
struct MoverShadow {
  std::int32_t x0, y0, x1, y1;
};

struct ShadeJob {
  Target target;
  Vertices vertices;
  const std::uint32_t* corners[3];
  const std::uint32_t* texture_of_triangle;
  const std::uint32_t* shadowing_of_triangle;  // a Shadowing, or kFirstShadowingGrid + number of a grid
  const ShadowingGrid* shadowing_grids;
  const Shadowing* shadowing_blocks;
  const MoverShadow* mover_shadows;  // within these nothing is lit for certain
  std::int32_t mover_shadow_count;
  const float* attributes;        // [kAttributes] a vertex; of statics
  const float* mover_attributes;  // likewise, of vertices from `first_mover_vertex` on
  std::uint32_t first_mover_vertex;
  const std::uint32_t* drawn;  // numbers of the triangles that the target's ids speak of
  TrianglePlanes* planes;      // by id, made when first needed; number 0 is all zeros but for `frame`
  std::uint32_t frame;         // never the same twice
  const TextureView* textures;
  const std::uint16_t* words[3];    // by channel
  const std::uint32_t* shadow_map;  // as ShadowMap's words (shadow_map.h)
  int shadow_side;                  // texels
  int shadow_pitch;                 // words a row
  float sky_up[3];                  // z of the ray in world axes: at pixel (0, 0), by x, by y
  float sky_ray[4];                 // x and y of the ray with unit depth: at pixel (0, 0) and by pixel: x0, y0, dx, dy
  float sky_colours[9];             // zenith, horizon, ground; levels, by channel
  float brightness;                 // factor on the light
  int channels;                     // 1 or 3
  std::uint8_t* out;                // rows of width · channels
};

/// A normal (world axes, by the vertices' interpolation) over depth as planes over the picture, about a pixel that the
/// triangle covers.
struct alignas(64) NormalPlanes {
  float at[3];
  float by_x[3];
  float by_y[3];
  float reference_x;  // px
  float reference_y;
  std::uint32_t frame;  // that they were made for
};

struct NormalJob {
  Target target;
  Vertices vertices;
  const float* normals;        // [3] a vertex, world axes; of statics
  const float* mover_normals;  // likewise, of vertices from `first_mover_vertex` on
  std::uint32_t first_mover_vertex;
  const std::uint32_t* corners[3];
  const std::uint32_t* drawn;  // numbers of the triangles that the target's ids speak of
  NormalPlanes* planes;        // one each, made when first needed
  std::uint32_t frame;         // never the same twice
};

/// The normals of a picture, in axes of the caller's choice.
struct NormalPictureJob {
  NormalJob normals;
  float rotation[9];  // from world axes, row by row
  float* out;         // [3] a pixel, rows from the top; 0 where nothing is seen
};

/// A lamp in world axes: render/internal/air_and_lamps.h says what the numbers are.
struct Lamp {
  float position[3];
  float inverse_range_squared;
  float direction[3];
  float cone_cosine;
  float light[3];
  float cone_scale;
};

/// Grey or colour with lamps and fog, per pixel.
struct LitJob {
  ShadeJob shade;
  NormalJob normals;
  float eye[3];   // world axes, m
  float rays[9];  // the ray with unit depth, world axes: at pixel (0, 0), by column, by row
  const Lamp* lamps;
  std::int32_t lamp_count;
  float extinction;  // of the fog, 1/m; 0: none
  float sky_depth;   // optical depth of the zenith
  float fog[3];      // levels, by channel
};

/// The inner loops, one table for each instruction set. Both tables give the same bits.
struct Kernels {
  const char* name;
  /// Vertices [first, first + count), first a multiple of eight: column = (m[0..3] · p), row = (m[4..7] · p),
  /// depth = (m[8..11] · p).
  void (*transform)(const Positions& positions, const Vertices& vertices, std::uint32_t first, std::uint32_t count,
                    const float* m, float near);
  /// Puts those triangles into `to_clip` that may show, in their order; returns their number.
  std::uint32_t (*choose)(const DrawJob& job);
  /// Returns the number of triangles in `to_clip`.
  std::uint32_t (*draw)(const DrawJob& job);
  void (*draw_one)(const Target& target, const ScreenTriangle& triangle);
  /// As `draw_one`, but for the pixels where alpha is below half.
  void (*draw_with_holes)(const Target& target, const ScreenTriangle& triangle, const HolePlanes& holes);
  void (*shade)(const ShadeJob& job);
  /// Depth in m of each pixel, 0 where nothing is nearer than 1/`farthest`.
  void (*metres)(const Target& target, float farthest, float* out);
  void (*normals)(const NormalPictureJob& job);
  /// As `shade`, with lamps and fog.
  void (*shade_lit)(const LitJob& job);
};
const Kernels& ScalarKernels();
/// Null where this processor or this build does not have AVX2 and FMA.
const Kernels* Avx2KernelsOrNull();

}  // namespace alula::render::raster
