// The brightest colour, a count, colours and alphas of as many fragments (500 at most): colour and transmittance of their tail,
// of the kind that FLK_SPEC_TAIL says.
#version 460
#extension GL_GOOGLE_include_directive : require
#define IN 2002
#define OUT 4
#include "items.glsl"
#include "shared/node.h"

struct FrameValues {
  float tail_range;
};
FrameValues frame;
#include "passes/tail.glsl"

void main() {
  if (noItem()) return;
  frame.tail_range = in1(0);
  uint count = uint(in1(1));
  Tail tail = emptyTail();
  for (uint i = 0u; i < count; ++i) addToTail(tail, in1(5u + 4u * i), in3(2u + 4u * i));
  closeTail(tail);
  out3(0, tail.color);
  out1(3, tail.transmittance);
}
