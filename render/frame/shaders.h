// The GLSL of every pass.
#pragma once

#include <string>

namespace billow::render::shaders {

/// The shader with `head` after its first line, which names the version.
std::string headed(const std::string& shader, const std::string& head);

// lit_fragment knows CUT_OUT and BLEND when one of them is defined. Velocity, geometry and depth need hole_functions at
// their heads, and with HOLES defined drop what the texture's alpha cuts out.
extern const char* const hole_functions;
extern const char* const surface_vertex;         // a body's corner -> clip space
extern const char* const lit_fragment;           // lit, textured, two-sided
extern const char* const velocity_fragment;      // a body in colours of its velocity; to be followed by one of
extern const char* const component_colour;       // - components as RGB
extern const char* const magnitude_colour;       // - speed through a colour ramp
extern const char* const geometry_fragment;      // which triangle of which body, and its unlit colour
extern const char* const screen_vertex;          // a triangle that covers the target, at the far plane
extern const char* const gradient_functions;     // the vertical gradient that the next and ground_fragment end with
extern const char* const background_fragment;    // vertical gradient
extern const char* const ground_vertex;          // a square of the ground plane
extern const char* const ground_fragment;        // ground that fades into the background
extern const char* const shade_fragment;         // the shadow on the ground, to multiply with
extern const char* const shadow_alpha_fragment;  // the same as black with an alpha
extern const char* const copy_fragment;          // the plain picture as it is
extern const char* const depth_vertex;           // a body's corner -> the light's clip space
extern const char* const depth_fragment;         // nothing but depth
extern const char* const occlusion_fragment;     // how much of the key light each texel of the ground patch misses
extern const char* const blur_fragment;          // a small tent blur

}  // namespace billow::render::shaders
