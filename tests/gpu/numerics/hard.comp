// Two segments of a strand, a to b to c, half width, pixel centre: whether it belongs to the first, to the second (as
// FLK_METHOD_HARD has it), and with that method's own ends to a strand of the first alone.
#version 460
#extension GL_GOOGLE_include_directive : require
#define IN 9
#define OUT 3
#include "items.glsl"
#include "lib/capture_fragment.glsl"

void main() {
  if (noItem()) return;
  vec2 a = in2(0), b = in2(2), c = in2(4), center = in2(7);
  float h = in1(6);
  FlatSegment first = flatSegment(a, b, b - a), second = flatSegment(b, c, c - b);
  float reach = h + max(pixelHalfExtent(first.t), pixelHalfExtent(second.t));
  QuadEnd end = jointEnd(b, reach, first, second, true), start = jointEnd(b, reach, first, second, false);
  vec4 extent = vec4(h, h, 0.0, 0.0);
  out1(0, insideHard(center, vec4(a, b), vec4(vec2(0.0), end.line), extent, first.t, first.l) ? 1.0 : 0.0);
  out1(1, insideHard(center, vec4(b, c), vec4(start.line, vec2(0.0)), extent, second.t, second.l) ? 1.0 : 0.0);
  out1(2, insideHard(center, vec4(a, b), vec4(0.0), extent, first.t, first.l) ? 1.0 : 0.0);
}
