#pragma once

namespace alula::render::internal {

// GLSL of the passes. Light per vertex: flat faces and the round ones' fine tessellation make the difference to light
// per pixel invisible, and llvmpipe pays per pixel.

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
}
)";

/// Grey: the texture holds luma already. Colour: the same with RGB.
inline constexpr const char* kGreyFragment = R"(#version 330 core
in vec2 uv;
in vec2 shade;
in vec3 shadow_at;
uniform sampler2D albedo;
uniform sampler2DShadow shadow_map;
const float kSharper = -0.5;  // levels; isotropic mip-maps blur ground that is seen at a low angle
layout(location = 0) out float value;
void main() { value = texture(albedo, uv, kSharper).r * mix(shade.x, shade.y, texture(shadow_map, shadow_at)); }
)";
/// Grey without a look-up in the shadow map: what faces the sun is lit.
inline constexpr const char* kShadowlessGreyFragment = R"(#version 330 core
in vec2 uv;
in vec2 shade;
uniform sampler2D albedo;
const float kSharper = -0.5;
layout(location = 0) out float value;
void main() { value = texture(albedo, uv, kSharper).r * shade.y; }
)";
inline constexpr const char* kColourFragment = R"(#version 330 core
in vec2 uv;
in vec2 shade;
in vec3 shadow_at;
uniform sampler2D albedo;
uniform sampler2DShadow shadow_map;
const float kSharper = -0.5;  // levels; isotropic mip-maps blur ground that is seen at a low angle
layout(location = 0) out vec4 value;
void main() { value = vec4(texture(albedo, uv, kSharper).rgb * mix(shade.x, shade.y, texture(shadow_map, shadow_at)), 1.0); }
)";

/// Position alone, for the depth pass and the shadow map.
inline constexpr const char* kPositionVertex = R"(#version 330 core
layout(location = 0) in vec3 position;
uniform mat4 clip_from_world;
uniform mat4x3 world_from_model;
void main() { gl_Position = clip_from_world * vec4(world_from_model * vec4(position, 1.0), 1.0); }
)";
/// Depth along the optical axis is the clip coordinate w.
inline constexpr const char* kDepthFragment = R"(#version 330 core
layout(location = 0) out float metres;
void main() { metres = 1.0 / gl_FragCoord.w; }
)";
inline constexpr const char* kShadowFragment = R"(#version 330 core
void main() {}
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
layout(location = 0) out vec4 value;
void main() {
  float up = normalize(direction).z;
  float high = clamp(up, 0.0, 1.0);
  float low = clamp(-20.0 * up, 0.0, 1.0);
  value = vec4(mix(mix(horizon, zenith, high * (2.0 - high)), ground, low), 1.0);
}
)";

}  // namespace alula::render::internal
