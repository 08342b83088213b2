// Capture by the rasteriser: each fragment of a quad into its pixel's list (Hillesland et al. 2014, section 3.1).
#version 460
#extension GL_GOOGLE_include_directive : require
#define FLK_BIND_HAIR
#define FLK_BIND_LISTS
#include "bindings.glsl"
#include "screen_segment.glsl"
#include "capture_input.glsl"
#include "capture_quad.glsl"

void main() { captureQuad(shapeHere(), uvec2(gl_FragCoord.xy), !gl_HelperInvocation); }
