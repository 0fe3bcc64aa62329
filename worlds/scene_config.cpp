#include <numbers>

#include "worlds/scene.h"
#include "worlds/textures.h"

namespace alula::worlds {
namespace {

constexpr double kFarthest = 1e4;  // m, of anything from the origin
constexpr double kPi = std::numbers::pi;

void Place(base::Description& d, const char* name, base::Vec3& p, const char* meaning) {
  d.Field(name, p, {.unit = "m", .meaning = meaning, .min = -kFarthest, .max = kFarthest});
}
void Length(base::Description& d, const char* name, double& length, const char* meaning) {
  d.Field(name, length, {.unit = "m", .meaning = meaning, .min = 1e-3, .max = kFarthest});
}
void Angle(base::Description& d, const char* name, double& angle, const char* meaning) {
  d.Field(name, angle, {.unit = "rad", .meaning = meaning, .min = -2.0 * kPi, .max = 2.0 * kPi});
}

}  // namespace

void Describe(base::Description& d, SceneMaterial& c) {
  d.Field("colour", c.colour, {.meaning = "red, green and blue, times the picture", .min = 0.0, .max = 1.0});
  d.Field("pattern", c.pattern,
          {.meaning = "a picture of our own",
           .choices = {"plain",  "brick", "plaster", "concrete", "rubble", "paving", "gravel",
                       "wood",   "bark",  "foliage", "signal",   "pad",    "grass",  "asphalt",
                       "litter", "soil",  "tiles",   "metal",    "carpet", "paint"}});
  d.Field("texture", c.texture,
          {.meaning = "a PNG file in place of the pattern", .is_path = true, .origin = &c.texture_origin});
  Length(d, "texture_scale", c.texture_scale, "what one period of the picture covers");
}

void Describe(base::Description& d, SceneBox& c) {
  d.Field("size", c.size, {.unit = "m", .meaning = "length, width and height", .min = 1e-3, .max = kFarthest});
}
void Describe(base::Description& d, SceneSphere& c) { Length(d, "radius", c.radius, "radius"); }
void Describe(base::Description& d, SceneCylinder& c) {
  Length(d, "radius", c.radius, "radius");
  Length(d, "height", c.height, "height");
}
void Describe(base::Description& d, SceneCapsule& c) {
  Length(d, "radius", c.radius, "radius");
  Length(d, "height", c.height, "height with both caps");
  d.Check("height", [&c] {
    return c.height > 2.0 * c.radius ? std::string() : std::string("must be above twice the radius; or take a sphere");
  });
}
void Describe(base::Description& d, SceneCone& c) {
  Length(d, "radius", c.radius, "radius of the base");
  Length(d, "height", c.height, "height");
}
void Describe(base::Description& d, SceneMesh& c) {
  d.Field("file", c.file,
          {.meaning = "an .obj, .gltf or .glb file", .required = true, .is_path = true, .origin = &c.file_origin});
  d.Field("scale", c.scale, {.meaning = "of its lengths", .min = 1e-6, .max = 1e6});
}

void Describe(base::Description& d, SceneObject& c) {
  d.Field("name", c.name, {.meaning = "in messages and files", .origin = &c.name_origin});
  d.OneOf(
      "shape", c.shape,
      {.meaning = "what it is", .required = true, .choices = {"box", "sphere", "cylinder", "capsule", "cone", "mesh"}});
  Place(d, "position", c.position, "of its centre, or of a mesh's origin");
  Angle(d, "yaw", c.yaw, "about z, counter-clockwise from above");
  Angle(d, "pitch", c.pitch, "about its y axis, before yaw");
  Angle(d, "roll", c.roll, "about its x axis, before pitch");
  d.Field("material", c.material, {.meaning = "how it looks"});
  d.Field("class", c.semantic,
          {.meaning = "what it is to pictures of classes; a depth camera's pattern does not come back from glass",
           .choices = {std::begin(kSemanticNames), std::end(kSemanticNames)}});
  d.Check("class", [&c] {
    return c.semantic == SemanticClass::kSky ? std::string("cannot be sky: nothing is seen there") : std::string();
  });
  d.Field("collides", c.collides, {.meaning = "whether it can be hit"});
}

void Describe(base::Description& d, SceneSwing& c) {
  d.Field("amplitude", c.amplitude, {.unit = "rad", .meaning = "to each side", .min = 0.0, .max = 0.8});
  d.Field("period", c.period, {.unit = "s", .meaning = "there and back", .min = 0.5, .max = 60.0});
}

void Describe(base::Description& d, SceneGate& c) {
  Place(d, "position", c.position, "of the opening's centre");
  Angle(d, "yaw", c.yaw, "of the direction of passage");
  d.Field("opening", c.opening, {.unit = "m", .meaning = "side of the opening", .min = 0.1, .max = 20.0});
  d.Field("frame", c.frame, {.unit = "m", .meaning = "width of its bars", .min = 0.01, .max = 2.0});
  d.Field("material", c.material, {.meaning = "how its frame looks"});
  d.Field("swing", c.swing, {.meaning = "about a hinge at its left; null: it stands"});
  d.Check("position", [&c] {
    return c.position.z() > 0.5 * c.opening + c.frame
               ? std::string()
               : std::string("must lie higher than half of the opening and the frame, as gates stand on the ground");
  });
}

void Describe(base::Description& d, SceneGround& c) {
  d.Field("size", c.size, {.unit = "m", .meaning = "side of the square of ground", .min = 1.0, .max = kFarthest});
  d.Field("material", c.material, {.meaning = "how it looks"});
}

void Describe(base::Description& d, SceneConfig& c) {
  d.Field("ground", c.ground, {.meaning = "flat, at z = 0, about the origin"});
  d.Field("objects", c.objects, {.meaning = "what stands there"});
  d.Field("gates", c.gates, {.meaning = "in order of passage"});
  Place(d, "pad_position", c.pad_position, "of the foot of the pad, on which the vehicle starts");
  d.Field("pad_radius", c.pad_radius, {.unit = "m", .meaning = "radius of the pad", .min = 0.3, .max = 4.0});
  Angle(d, "start_yaw", c.start_yaw, "heading at the start");
  Place(d, "target", c.target, "where the course ends");
  d.Field("bounds_low", c.bounds_low,
          {.unit = "m", .meaning = "of the box to stay in; null: the ground", .min = -kFarthest, .max = kFarthest});
  d.Field("bounds_high", c.bounds_high,
          {.unit = "m", .meaning = "of the box to stay in; null: the ground", .min = -kFarthest, .max = kFarthest});
  Angle(d, "sun_azimuth", c.sun_azimuth, "where the sun stands, from east to north");
  d.Field("sun_elevation", c.sun_elevation,
          {.unit = "rad", .meaning = "of the sun above the horizon", .min = 0.05, .max = 0.5 * kPi});
  d.Field("sun", c.sun, {.meaning = "strength of direct light", .min = 0.0, .max = 4.0});
  d.Field("ambient", c.ambient, {.meaning = "strength of light from everywhere", .min = 0.0, .max = 4.0});
  d.Field("sky", c.sky, {.meaning = "its red, green and blue", .min = 0.0, .max = 1.0});
  d.Field("wind_mean", c.wind_mean, {.unit = "m/s", .meaning = "mean velocity of the air, world axes"});
  d.Field("gust_sigma", c.gust_sigma,
          {.unit = "m/s", .meaning = "standard deviation of gusts per axis", .min = 0.0, .max = 20.0});
  d.Field("gust_time", c.gust_time, {.unit = "s", .meaning = "correlation time of gusts", .min = 0.05, .max = 60.0});
  d.Field("wind", c.wind, {.meaning = "in place of wind_mean and gusts; null: they hold"});
  DescribeActors(d, c.actors);
  DescribeTextureSize(d, c.texture_size);
}

}  // namespace alula::worlds
