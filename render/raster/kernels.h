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
  std::uint32_t* to_clip;  // out: numbers of the triangles that the caller must clip; room for `count`
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

/// Attributes over depth as planes over the picture, relative to a pixel that the triangle covers.
struct alignas(64) TrianglePlanes {
  float at[kAttributes];
  float by_x[kAttributes];
  float by_y[kAttributes];
  float reference_x;  // px
  float reference_y;
  std::uint32_t frame;  // that they were made for
  std::uint32_t texture;
  std::uint32_t sunny;  // the sun adds light somewhere on it
  std::uint32_t unused[3];
};

struct ShadeJob {
  Target target;
  Vertices vertices;
  const std::uint32_t* corners[3];
  const std::uint32_t* texture_of_triangle;
  const float* attributes;        // [kAttributes] a vertex; of statics
  const float* mover_attributes;  // likewise, of vertices from `first_mover_vertex` on
  std::uint32_t first_mover_vertex;
  const std::uint32_t* drawn;  // numbers of the triangles that the target's ids speak of
  TrianglePlanes* planes;      // by id, made when first needed; number 0 is all zeros but for `frame`
  std::uint32_t frame;         // never the same twice
  const TextureView* textures;
  const std::uint16_t* words[3];    // by channel
  const std::uint16_t* shadow_map;  // distances from the sun, 1/65535, less 2¹⁵ (as numbers with a sign); row by row
  int shadow_side;                  // texels
  int shadow_pitch;                 // words a row
  float sky_up[3];                  // z of the ray in world axes: at pixel (0, 0), by x, by y
  float sky_ray[4];                 // x and y of the ray with unit depth: at pixel (0, 0) and by pixel: x0, y0, dx, dy
  float sky_colours[9];             // zenith, horizon, ground; levels, by channel
  float brightness;                 // factor on the light
  int channels;                     // 1 or 3
  std::uint8_t* out;                // rows of width · channels
};

/// The inner loops, one table for each instruction set. Both tables give the same bits.
struct Kernels {
  const char* name;
  /// Vertices [first, first + count), first a multiple of eight: column = (m[0..3] · p), row = (m[4..7] · p),
  /// depth = (m[8..11] · p).
  void (*transform)(const Positions& positions, const Vertices& vertices, std::uint32_t first, std::uint32_t count,
                    const float* m, float near);
  /// Returns the number of triangles in `to_clip`.
  std::uint32_t (*draw)(const DrawJob& job);
  void (*draw_one)(const Target& target, const ScreenTriangle& triangle);
  void (*shade)(const ShadeJob& job);
  /// Depth in m of each pixel, 0 where nothing is nearer than 1/`farthest`.
  void (*metres)(const Target& target, float farthest, float* out);
};
const Kernels& ScalarKernels();
/// Null where this processor or this build does not have AVX2 and FMA.
const Kernels* Avx2KernelsOrNull();

}  // namespace alula::render::raster
