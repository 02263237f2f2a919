// The GLSL of every pass.
#pragma once

namespace billow::render::shaders {

extern const char* const kSurfaceVertex;       // a body's corner -> clip space
extern const char* const kClothFragment;       // lit, textured, two-sided
extern const char* const kVelocityFragment;    // a body in colours of its velocity; to be followed by one of
extern const char* const kComponentColour;     // - components as RGB
extern const char* const kMagnitudeColour;     // - speed through a colour ramp
extern const char* const kScreenVertex;        // a triangle that covers the target, at the far plane
extern const char* const kGradient;            // the vertical gradient that the next and kGroundFragment end with
extern const char* const kBackgroundFragment;  // vertical gradient
extern const char* const kGroundVertex;        // a square of the ground plane
extern const char* const kGroundFragment;      // ground that fades into the background
extern const char* const kShadeFragment;       // the shadow on the ground, to multiply with
extern const char* const kCopyFragment;        // the plain picture as it is
extern const char* const kDepthVertex;         // a body's corner -> the light's clip space
extern const char* const kDepthFragment;       // nothing but depth
extern const char* const kOcclusionFragment;   // how much of the key light each texel of the ground patch misses
extern const char* const kBlurFragment;        // a small tent blur

}  // namespace billow::render::shaders
