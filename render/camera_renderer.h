#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/frames.h"
#include "stack/interface/calibration.h"
#include "worlds/world.h"

namespace alula::render {

/// A thing that moves or is drawn besides the world: a shape with its material, placed anew for each picture.
struct Mover {
  std::string name;
  geometry::Shape shape;
  geometry::Material material;
  worlds::SemanticClass semantic = worlds::SemanticClass::kVehicle;
  bool of_vehicle = true;  // the vehicle's own, which View::draw_movers hides
  bool casts_shadow = true;
  double texture_scale = 1.0;  // m per texture period; a mesh has texture coordinates of its own
};
/// The links of the world's actors as movers, one actor after the other; world.materials must hold their materials.
std::vector<Mover> MoversOf(const worlds::World& world);

/// Where a camera is and how it sees: u = fx·x/z + cx, v = fy·y/z + cy, integer coordinates being pixel centres.
/// Distortion is not applied: a view whose coefficients are not zero throws base::InputError.
struct View {
  base::Transform X_WC;
  stack::CameraIntrinsics intrinsics;
  bool draw_movers = true;  // false for a camera that sits inside the vehicle: its own movers are not drawn, their
                            // shadows stay
  float brightness = 1.0F;  // exposure times gain over the nominal one: a factor on the signal of grey and colour
                            // pictures before it is rounded to eight bits and cut off at 255
  bool infrared = false;    // grey pictures by the materials' albedo in the near infrared
  std::vector<worlds::Lamp> lamps{};  // that ride with the camera (at most 8), in camera axes
};

/// A camera's picture before its sensor: grey values or RGB in [0, 255], rows from the top.
struct Picture {
  int width = 0;
  int height = 0;
  int channels = 1;
  std::vector<std::uint8_t> bytes;
};

/// Planar depth (along the optical axis), m; 0 where nothing is seen within [0.05 m, 200 m].
struct DepthPicture {
  int width = 0;
  int height = 0;
  std::vector<float> metres;
};

/// What is seen at each pixel, rows from the top.
struct SurfacePicture {
  int width = 0;
  int height = 0;
  std::uint32_t first_mover = 1;               // instance of the first mover: number of the world's objects + 1
  std::vector<std::uint32_t> instances;        // number of the object in the world + 1, then the movers; 0: sky
  std::vector<worlds::SemanticClass> classes;  // of the object or mover
  std::vector<Eigen::Vector3f> normals;        // of the surface in camera axes, unit, as its vertices' normals say
                                               // (round things are smooth); 0 where the sky is seen
};

/// Draws the world as cameras see it. The same inputs give the same bytes. A renderer may be called from any thread,
/// but from one at a time; several renderers may live side by side. Buffers of `out` are reused where they fit.
class CameraRenderer {
 public:
  virtual ~CameraRenderer() = default;
  /// Poses of the movers, in the order they were given at the making; they hold until the next call (identity before
  /// the first one). Throws base::FaultError when the number is not that of the movers.
  virtual void PlaceMovers(std::span<const base::Transform> X_WM) = 0;
  virtual void Grey(const View& view, Picture& out) = 0;
  virtual void Colour(const View& view, Picture& out) = 0;
  virtual void Depth(const View& view, DepthPicture& out) = 0;
  virtual void Surface(const View& view, SurfacePicture& out) = 0;
  /// Whether anything of that class is in the world or moves in it.
  virtual bool Has(worlds::SemanticClass semantic) const = 0;
  /// A second renderer of the same scene, for another thread at the same time; what never changes is shared. Its movers
  /// stand at identity until they are placed in it too. Throws as MakeRenderer does.
  virtual std::unique_ptr<CameraRenderer> Twin() const = 0;
  /// "osmesa 22.3.6 llvmpipe …": goes into the numeric class.
  virtual std::string Description() const = 0;
};

/// `maker`: "osmesa", "egl", "raster" (our own, on any processor, fast with AVX2 and FMA), or "auto" (raster where the
/// processor has those, else OSMesa where it is there, else EGL). Throws base::InputError for another word or where the
/// maker is not available.
std::unique_ptr<CameraRenderer> MakeRenderer(std::string_view maker, const worlds::World& world,
                                             std::span<const Mover> movers);
/// One of a world by itself, its actors placed as they are at the begin of a run with this seed.
std::unique_ptr<CameraRenderer> MakeRendererAtStart(std::string_view maker, const worlds::World& world,
                                                    std::uint64_t seed);

}  // namespace alula::render
