// GLSL 3.30. Colours are linear light throughout; the sRGB framebuffer encodes them. llvmpipe runs both sides of an
// `if`, so work is skipped by loops that need no turn.
#include "render/frame/shaders.h"

namespace billow::render::shaders {

std::string headed(const std::string& shader, const std::string& head) {
  return std::string(shader).insert(shader.find('\n') + 1, head);
}

const char* const surface_vertex = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 velocity;
layout(location = 3) in vec2 texture_place;
layout(location = 4) in vec3 own_colour;
uniform mat4 view_projection;
out vec3 world;
out vec3 world_normal;
out vec3 world_velocity;
out vec2 place;
out vec3 tint;

void main() {
  world = position;
  tint = own_colour;
  world_normal = normal;
  world_velocity = velocity;
  place = texture_place;
  gl_Position = view_projection * vec4(position, 1.0);
}
)";

const char* const lit_fragment = R"(#version 330 core
in vec3 world;
in vec3 world_normal;
in vec2 place;
in vec3 tint;
uniform sampler2D albedo_map;
uniform sampler2DShadow shadow_map;
uniform mat4 light_texture;   // world -> (u, v, depth) in the shadow map
uniform vec3 colour;
uniform vec3 eye;
uniform vec3 to_light;
uniform vec3 to_fill;
uniform float shadow_offset;  // [m] along the normal, against a surface shadowing itself
uniform vec2 shadow_blur;     // [texture] radius of the filter disc
uniform float opacity;
uniform float cutoff;
out vec4 pixel;

// How much of the pixel the surface covers, or how much of what is behind it hides.
#if defined(CUT_OUT)
// Near by the edge lies where the alpha crosses the cutoff; where texels are finer than pixels, a pixel's mean alpha is
// the share of it that is covered, or threads thinner than a pixel would vanish.
float shown(float alpha) {
  float edge = (alpha * opacity - cutoff) / max(fwidth(alpha * opacity), 1e-4) + 0.5;
  vec2 texel = place * vec2(textureSize(albedo_map, 0));
  float level = 0.5 * log2(max(dot(dFdx(texel), dFdx(texel)), dot(dFdy(texel), dFdy(texel))));
  float share = mix(edge, alpha * opacity, clamp(level, 0.0, 1.0));
  if (share <= 0.0) discard;
  return min(share, 1.0);
}
#elif defined(BLEND)
float shown(float alpha) { return alpha * opacity; }
#else
float shown(float alpha) { return 1.0; }
#endif

const vec3 key_light = vec3(1.42, 1.33, 1.22);
const vec3 sky_light = vec3(0.33, 0.37, 0.43);
const vec3 ground_bounce = vec3(0.22, 0.20, 0.18);
const vec3 fill_light = vec3(0.16, 0.18, 0.21);
// The outer four taps of the disc tell whether the other four are needed.
const int outer_taps = 4, all_taps = 8;
const vec2 tap_place[8] = vec2[](vec2(0.92, 0.38), vec2(-0.38, 0.92), vec2(-0.92, -0.38), vec2(0.38, -0.92),
                             vec2(0.40, 0.10), vec2(-0.10, 0.40), vec2(-0.40, -0.10), vec2(0.10, -0.40));

float key_visibility(vec3 lit_side) {
  vec3 c = (light_texture * vec4(world + lit_side * shadow_offset, 1.0)).xyz;
  float sum = 0.0;
  for (int i = 0; i < outer_taps; ++i) sum += texture(shadow_map, vec3(c.xy + tap_place[i] * shadow_blur, c.z));
  int taps = sum > 0.01 && sum < 3.99 ? all_taps : outer_taps;
  for (int i = outer_taps; i < taps; ++i) sum += texture(shadow_map, vec3(c.xy + tap_place[i] * shadow_blur, c.z));
  return sum / float(taps);
}

void main() {
  vec3 n = normalize(gl_FrontFacing ? world_normal : -world_normal);
  vec3 to_eye = normalize(eye - world);
  vec4 texel = texture(albedo_map, place);
  float alpha = shown(texel.a);
  vec3 albedo = texel.rgb * colour * tint;
  float luma = dot(albedo, vec3(0.2126, 0.7152, 0.0722));
  albedo = gl_FrontFacing ? albedo : 0.78 * mix(albedo, vec3(luma), 0.30);

  float facing = dot(n, to_light);
  float visible = key_visibility(facing > 0.0 ? n : -n);
  // As through thin cloth, some of the key light comes through from behind.
  vec3 key = key_light * visible * (facing > 0.0 ? facing : -0.22 * facing);
  // Sky and ground all around, a large soft lamp on the other side, and less of both deep in a fold.
  float to_eye_facing = max(dot(n, to_eye), 0.0);
  float fill = 0.5 + 0.5 * dot(n, to_fill);
  vec3 ambient = mix(ground_bounce, sky_light, 0.5 + 0.5 * n.y) + fill_light * fill * fill;
  ambient *= 0.5 + 0.5 * to_eye_facing;

  // Sheen: fibres that stand off the cloth catch light at grazing angles.
  float grazing = 1.0 - to_eye_facing;
  float sheen = 0.10 * grazing * grazing * grazing;
  float half_facing = max(dot(n, normalize(to_light + to_eye)), 0.0);
  float gloss = half_facing * half_facing;
  gloss *= gloss;
  gloss *= gloss;
  gloss = 0.05 * gloss * gloss * visible * max(facing, 0.0);

  vec3 shaded = albedo * (key + ambient) + sheen * ambient + gloss * key_light;
  pixel = vec4(shaded / (1.0 + 0.12 * shaded * shaded), alpha);  // a soft shoulder keeps white from clipping
}
)";

const char* const hole_functions = R"(
#ifdef HOLES
in vec2 place;
uniform sampler2D albedo_map;
uniform float opacity;
uniform float hole_below;
void drop_holes() {
  if (textureLod(albedo_map, place, 0.0).a * opacity < hole_below) discard;
}
#else
void drop_holes() {}
#endif
)";

const char* const velocity_fragment = R"(#version 330 core
in vec3 world;
in vec3 world_normal;
in vec3 world_velocity;
uniform vec3 eye;
uniform float shading;         // 0: flat, exact colours
uniform float velocity_range;  // [m/s]
out vec4 pixel;

vec3 velocity_colour(vec3 v);  // linear light

// 1 where the surface faces the eye, so that those colours are exact; folds that turn away darken.
void main() {
  drop_holes();
  float facing = abs(dot(normalize(world_normal), normalize(eye - world)));
  pixel = vec4(velocity_colour(world_velocity / velocity_range) * (1.0 - shading * (1.0 - facing)), 1.0);
}
)";

const char* const component_colour = R"(
// c = 1/2 + 1/2 v / v_max is the sRGB-encoded colour; the framebuffer wants linear light.
vec3 velocity_colour(vec3 v) {
  vec3 c = clamp(0.5 + 0.5 * v, 0.0, 1.0);
  return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), step(0.04045, c));
}
)";

const char* const magnitude_colour = R"(
uniform sampler2D ramp;  // 256 x 1, sRGB
vec3 velocity_colour(vec3 v) {
  return texture(ramp, vec2((0.5 + 255.0 * min(length(v), 1.0)) / 256.0, 0.5)).rgb;
}
)";

const char* const geometry_fragment = R"(#version 330 core
#ifndef HOLES
in vec2 place;
uniform sampler2D albedo_map;
#endif
in vec3 tint;
uniform vec3 colour;
uniform int body;   // counted from 1: 0 is nothing
uniform int first;  // triangle of those that are drawn
layout(location = 0) out uvec2 hit;
layout(location = 1) out vec4 albedo;

void main() {
  drop_holes();
  hit = uvec2(uint(body), uint(first + gl_PrimitiveID));
  albedo = vec4(texture(albedo_map, place).rgb * colour * tint, 1.0);
}
)";

const char* const screen_vertex = R"(#version 330 core
out vec2 place;  // (-1, -1) bottom left to (1, 1) top right

void main() {
  place = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  gl_Position = vec4(place, 1.0, 1.0);
}
)";

const char* const gradient_functions = R"(
uniform vec3 top;
uniform vec3 bottom;
uniform float frame_height;  // [pixel]
uniform vec2 tile_corner;    // [pixel] of the picture, where what is drawn now begins

vec3 gradient() { return mix(bottom, top, smoothstep(0.0, frame_height, tile_corner.y + gl_FragCoord.y)); }

// Steps of 1/255 in a wide gradient show as bands: columns that step at different heights hide them. The pattern is the
// same in every row, because PNG then still finds each row equal to the one above.
vec4 dithered(vec3 colour) {
  int column = int(tile_corner.x + gl_FragCoord.x);
  int reversed = (column & 1) << 2 | (column & 2) | (column & 4) >> 2;
  return vec4(colour * (1.0 + (float(reversed) - 3.5) / 8.0 * 2.2 / 255.0), 1.0);
}
)";

const char* const background_fragment = R"(#version 330 core
vec3 gradient();
vec4 dithered(vec3 colour);
out vec4 pixel;

void main() { pixel = dithered(gradient()); }
)";

const char* const ground_vertex = R"(#version 330 core
uniform mat4 view_projection;
uniform vec3 centre;    // [m]
uniform vec3 half_u;    // [m]
uniform vec3 half_v;
out vec2 place;         // in [-1, 1]

void main() {
  place = vec2((gl_VertexID & 1) == 0 ? -1.0 : 1.0, (gl_VertexID & 2) == 0 ? -1.0 : 1.0);
  gl_Position = view_projection * vec4(centre + place.x * half_u + place.y * half_v, 1.0);
}
)";

const char* const ground_fragment = R"(#version 330 core
vec3 gradient();
vec4 dithered(vec3 colour);
in vec2 place;
uniform vec3 floor_colour;
out vec4 pixel;

void main() {
  float near = max(1.0 - dot(place, place), 0.0);
  pixel = dithered(mix(gradient(), floor_colour, near * near * near));
}
)";

const char* const shade_fragment = R"(#version 330 core
in vec2 place;
uniform sampler2D occlusion;
uniform vec3 shadow_tint;  // what is left of the light in full shadow
out vec4 pixel;

void main() { pixel = vec4(mix(vec3(1.0), shadow_tint, texture(occlusion, 0.5 + 0.5 * place).r), 1.0); }
)";

const char* const shadow_alpha_fragment = R"(#version 330 core
in vec2 place;
uniform sampler2D occlusion;
uniform vec3 shadow_tint;
out vec4 pixel;

// Black that takes as much light as the shadow does.
void main() {
  float taken = 1.0 - dot(shadow_tint, vec3(0.2126, 0.7152, 0.0722));
  pixel = vec4(0.0, 0.0, 0.0, taken * texture(occlusion, 0.5 + 0.5 * place).r);
}
)";

const char* const copy_fragment = R"(#version 330 core
uniform sampler2D picture;
out vec4 pixel;

void main() { pixel = texelFetch(picture, ivec2(gl_FragCoord.xy), 0); }
)";

const char* const depth_vertex = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 3) in vec2 texture_place;
uniform mat4 light_projection;
out vec2 place;

void main() {
  place = texture_place;
  gl_Position = light_projection * vec4(position, 1.0);
}
)";

const char* const depth_fragment = R"(#version 330 core
void main() { drop_holes(); }
)";

const char* const occlusion_fragment = R"(#version 330 core
in vec2 place;
uniform sampler2D depth_map;
uniform mat4 patch_to_light;  // (s, t, 0, 1) on the ground -> (u, v, depth) in the shadow map
uniform vec3 light_size;      // [m]
uniform float spread;
out vec4 pixel;

const int search_taps = 10;
const int shadow_taps = 20;

// Vogel's spiral: n points spread evenly over the unit disc.
vec2 disc(int i, int n, float turn) {
  float angle = 2.3999632 * float(i) + turn;
  return sqrt((float(i) + 0.5) / float(n)) * vec2(cos(angle), sin(angle));
}

// Percentage-closer soft shadows (Fernando 2005): the penumbra is as wide as the blockers are far.
void main() {
  vec3 c = (patch_to_light * vec4(place, 0.0, 1.0)).xyz;
  float turn = 6.2831853 * fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
  vec2 reach = spread * light_size.z / light_size.xy;  // [texture] per unit of depth
  float nearest = min(c.z, 1.0);
  float distance = 0.0;
  float blockers = 0.0;
  for (int i = 0; i < search_taps; ++i) {
    float depth = texture(depth_map, c.xy + disc(i, search_taps, turn) * reach * c.z).r;
    float blocks = depth < nearest ? 1.0 : 0.0;
    distance += blocks * (c.z - depth);
    blockers += blocks;
  }
  int taps = blockers > 0.0 ? shadow_taps : 0;
  vec2 radius = reach * distance / max(blockers, 1.0);
  float hits = 0.0;
  for (int i = 0; i < taps; ++i)
    hits += texture(depth_map, c.xy + disc(i, shadow_taps, turn) * radius).r < nearest ? 1.0 : 0.0;
  pixel = vec4(hits / float(shadow_taps));
}
)";

const char* const blur_fragment = R"(#version 330 core
in vec2 place;
uniform sampler2D image;
uniform vec2 texel;
out vec4 pixel;

// Bilinear taps between the texels: 16 of them in 4 reads of a 4 x 4 tent.
void main() {
  vec2 p = 0.5 + 0.5 * place;
  vec4 sum = texture(image, p + vec2(-1.0, -1.0) * texel) + texture(image, p + vec2(1.0, -1.0) * texel) +
             texture(image, p + vec2(-1.0, 1.0) * texel) + texture(image, p + vec2(1.0, 1.0) * texel) +
             2.0 * (texture(image, p + vec2(0.0, -1.0) * texel) + texture(image, p + vec2(0.0, 1.0) * texel) +
                    texture(image, p + vec2(-1.0, 0.0) * texel) + texture(image, p + vec2(1.0, 0.0) * texel)) +
             4.0 * texture(image, p);
  pixel = sum / 16.0;
}
)";

}  // namespace billow::render::shaders
