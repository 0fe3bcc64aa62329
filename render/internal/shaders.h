#pragma once

namespace alula::render::internal {

// GLSL of the passes. Light of sun and sky per vertex: flat faces and the round ones' fine tessellation make the
// difference to light per pixel invisible, and llvmpipe pays per pixel. With LIT defined, lamps and fog come on top,
// per pixel. COLOUR: three channels instead of one. HOLES: what the texture's alpha says is not there is left out.
// SHADOWLESS (grey alone): what faces the sun is lit.

inline constexpr const char* kHoles = "#define HOLES\n";

/// World and movers: position, texture coordinates, light and place in the shadow map.
inline constexpr const char* kSurfaceVertex = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv_in;
uniform mat4 clip_from_world;
uniform mat4x3 world_from_model;
uniform mat4x3 shadow_from_world;
uniform vec3 to_sun;
uniform vec3 light;  // sun, ambient, offset along the normal for the shadow look-up (m)
uniform float brightness;
out vec2 uv;
out vec2 shade;  // in the shadow, in the sun
out vec3 shadow_at;
#ifdef LIT
out vec3 place;
out vec3 facing_to;
#endif
void main() {
  vec3 p = world_from_model * vec4(position, 1.0);
  vec3 n = mat3(world_from_model) * normal;
  float facing = dot(n, to_sun);
  uv = uv_in;
  // The sky is brightest above and about the sun; from below comes what the ground sends back.
  float sky = light.y * (0.75 + 0.20 * n.z + 0.10 * facing);
  float sun = light.x * max(facing, 0.0);
  // Textures hold displayed values, light is linear: the product in linear space, displayed again with gamma 2, is
  // texture times root of light. The exposure sets sunlit ground to its texture's own value, shadows to about half.
  shade = sqrt(max(vec2(0.6 * sky, 0.6 * sky + 1.4 * sun), 0.0)) * brightness;
  shadow_at = shadow_from_world * vec4(p + n * (light.z * sqrt(max(1.0 - facing * facing, 0.0))), 1.0);
  gl_Position = clip_from_world * vec4(p, 1.0);
#ifdef LIT
  place = p;
  facing_to = n;
#endif
}
)";

/// Grey: the texture holds luma already. Colour: the same with RGB.
inline constexpr const char* kSurfaceFragment = R"(#version 330 core
in vec2 uv;
in vec2 shade;
in vec3 shadow_at;
uniform sampler2D albedo;
uniform sampler2DShadow shadow_map;
const float kSharper = -0.5;  // levels; isotropic mip-maps blur ground that is seen at a low angle
#ifdef HOLES
uniform sampler2D alpha;
#endif
#ifdef COLOUR
layout(location = 0) out vec4 value;
#else
layout(location = 0) out float value;
#endif
#ifdef COLOUR
#define TEXEL rgb
#else
#define TEXEL rrr
#endif
#ifdef LIT
in vec3 place;
in vec3 facing_to;
uniform vec3 eye;
uniform int lamp_count;
uniform vec4 lamps[3 * MOST_LAMPS];  // as LampView
uniform vec3 fog;
uniform float extinction;

vec3 Lamplight() {
  vec3 normal = normalize(facing_to);
  vec3 sum = vec3(0.0);
  for (int i = 0; i < lamp_count; ++i) {
    vec3 to = lamps[3 * i].xyz - place;
    float square = max(dot(to, to), 1e-4);  // a lamp is 1 cm wide
    vec3 way = to * inversesqrt(square);
    float cone = clamp((-dot(way, lamps[3 * i + 1].xyz) - lamps[3 * i + 1].w) * lamps[3 * i + 2].w, 0.0, 1.0);
    float reach = square * lamps[3 * i].w;
    float fade = max(1.0 - reach * reach, 0.0);
    sum += lamps[3 * i + 2].xyz *
           (max(dot(normal, way), 0.0) * (cone * cone * (3.0 - 2.0 * cone)) * (fade * fade) / square);
  }
  return sum;
}

vec3 ThroughFog(vec3 seen) {
  float share = exp(-extinction * length(place - eye));
  return sqrt(seen * seen * share + fog * fog * (1.0 - share));
}
#endif
void main() {
#ifdef HOLES
  if (texture(alpha, uv, kSharper).r < 0.5) discard;
#endif
#ifdef LIT
  float light = mix(shade.x, shade.y, texture(shadow_map, shadow_at));
  vec3 seen = ThroughFog(texture(albedo, uv, kSharper).TEXEL * sqrt(light * light + Lamplight()));
#ifdef COLOUR
  value = vec4(seen, 1.0);
#else
  value = seen.r;
#endif
#elif defined(SHADOWLESS) && !defined(COLOUR)
  value = texture(albedo, uv, kSharper).r * shade.y;
#elif defined(COLOUR)
  value = vec4(texture(albedo, uv, kSharper).rgb * mix(shade.x, shade.y, texture(shadow_map, shadow_at)), 1.0);
#else
  value = texture(albedo, uv, kSharper).r * mix(shade.x, shade.y, texture(shadow_map, shadow_at));
#endif
}
)";

/// Position alone, for the depth pass and the shadow map.
inline constexpr const char* kPositionVertex = R"(#version 330 core
layout(location = 0) in vec3 position;
uniform mat4 clip_from_world;
uniform mat4x3 world_from_model;
#ifdef HOLES
layout(location = 2) in vec2 uv_in;
out vec2 uv;
#endif
void main() {
  gl_Position = clip_from_world * vec4(world_from_model * vec4(position, 1.0), 1.0);
#ifdef HOLES
  uv = uv_in;
#endif
}
)";
/// Depth along the optical axis is the clip coordinate w.
inline constexpr const char* kDepthFragment = R"(#version 330 core
layout(location = 0) out float metres;
#ifdef HOLES
in vec2 uv;
uniform sampler2D alpha;
#endif
void main() {
#ifdef HOLES
  if (texture(alpha, uv, -0.5).r < 0.5) discard;
#endif
  metres = 1.0 / gl_FragCoord.w;
}
)";

/// Normal in camera axes, and which instance it is of.
inline constexpr const char* kNormalVertex = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal_in;
uniform mat4 clip_from_world;
uniform mat4x3 world_from_model;
uniform mat3 camera_from_world;
out vec3 normal;
#ifdef HOLES
layout(location = 2) in vec2 uv_in;
out vec2 uv;
#endif
void main() {
#ifdef HOLES
  uv = uv_in;
#endif
  normal = camera_from_world * (mat3(world_from_model) * normal_in);
  gl_Position = clip_from_world * vec4(world_from_model * vec4(position, 1.0), 1.0);
}
)";
inline constexpr const char* kNormalFragment = R"(#version 330 core
in vec3 normal;
uniform float instance;
layout(location = 0) out vec4 value;
#ifdef HOLES
in vec2 uv;
uniform sampler2D alpha;
#endif
void main() {
#ifdef HOLES
  if (texture(alpha, uv, -0.5).r < 0.5) discard;
#endif
  value = vec4(normalize(normal), instance);
}
)";

inline constexpr const char* kShadowFragment = R"(#version 330 core
#ifdef HOLES
in vec2 uv;
uniform sampler2D alpha;
#endif
void main() {
#ifdef HOLES
  if (texture(alpha, uv, -0.5).r < 0.5) discard;
#endif
}
)";

/// One triangle that covers the picture at the far end of the depth range.
inline constexpr const char* kSkyVertex = R"(#version 330 core
uniform mat3 rays;  // columns: direction at the middle, its change to the right edge, to the bottom edge
out vec3 direction;
void main() {
  vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  direction = rays * vec3(1.0, corner);
  gl_Position = vec4(corner, 1.0, 1.0);
}
)";
/// From the horizon's haze to the zenith; below the horizon the haze darkens to ground.
inline constexpr const char* kSkyFragment = R"(#version 330 core
in vec3 direction;
uniform vec3 zenith;
uniform vec3 horizon;
uniform vec3 ground;
uniform vec3 fog;
uniform float sky_depth;  // optical depth of the zenith
layout(location = 0) out vec4 value;
void main() {
  float up = normalize(direction).z;
  float high = clamp(up, 0.0, 1.0);
  float low = clamp(-20.0 * up, 0.0, 1.0);
  value = vec4(mix(mix(horizon, zenith, high * (2.0 - high)), ground, low), 1.0);
#ifdef LIT
  float share = up > 0.0 ? exp(-sky_depth / max(up, 1e-4)) : 0.0;
  value.rgb = sqrt(value.rgb * value.rgb * share + fog * fog * (1.0 - share));
#endif
}
)";

}  // namespace alula::render::internal
