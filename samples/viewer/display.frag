#version 460
// The picture into the window: hair over what is opaque over the ground; two of them beside each other, or their difference.
layout(set = 0, binding = 0) uniform sampler2D hair_first;
layout(set = 0, binding = 1) uniform sampler2D hair_second;
layout(set = 0, binding = 2) uniform sampler2D opaque;

layout(push_constant) uniform Push {
  vec4 rect;        // x, y, width, height of the picture in the window (px)
  vec4 ground;      // linear; alpha 0: a pattern that says transparent
  uint mode;        // 0: the first; 1: both with a divider; 2: their difference
  float divider;    // share of the width
  float gain;       // of the difference
  uint has_opaque;
  float scale;      // of hair that was drawn with another exposure
} push;

layout(location = 0) out vec4 color;

vec3 encodeSrgb(vec3 c) {
  c = clamp(c, vec3(0.0), vec3(1.0));
  return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, greaterThan(c, vec3(0.0031308)));
}

vec4 premultipliedOver(vec4 top, vec4 below) { return top + (1.0 - top.a) * below; }

void main() {
  const vec2 at = (gl_FragCoord.xy - push.rect.xy) / push.rect.zw;
  const bool second = push.mode == 1u && at.x > push.divider;
  vec4 first = second ? texture(hair_second, at) : texture(hair_first, at);
  first.rgb *= push.scale;
  if (push.mode == 2u) {
    const vec3 off = abs(first.rgb - texture(hair_second, at).rgb) * push.gain;
    color = vec4(encodeSrgb(off), 1.0);
    return;
  }
  if (push.has_opaque != 0u) {
    first = premultipliedOver(first, texture(opaque, at));
  }
  vec3 ground = push.ground.rgb;
  if (push.ground.a == 0.0) {
    const uvec2 cell = uvec2(gl_FragCoord.xy) / 16u;
    ground = vec3((cell.x + cell.y) % 2u == 0u ? 0.0176 : 0.0212);
  }
  first = premultipliedOver(first, vec4(ground, 1.0));
  color = vec4(encodeSrgb(first.rgb), 1.0);
  if (push.mode == 1u && abs(gl_FragCoord.x - push.rect.x - push.divider * push.rect.z) < 1.0) {
    color = vec4(0.95, 0.75, 0.3, 1.0);
  }
}
