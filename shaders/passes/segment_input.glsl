// A segment of the hair that the push constants name. Included after bindings.glsl.
#ifndef FORELOCK_PASSES_SEGMENT_INPUT
#define FORELOCK_PASSES_SEGMENT_INPUT
#include "../lib/strand_vertex.glsl"

struct Segment {
  uint vertex;     // the first
  bool root, tip;  // whether it begins, ends the strand
};

Segment readSegment(uint index) {
  uint word = WordList(frame.hairs[hair_slot].segments).at[index];
  return Segment(word & FLK_SEGMENT_VERTEX_MASK, (word & FLK_SEGMENT_ROOT) != 0u, (word & FLK_SEGMENT_TIP) != 0u);
}

vec3 positionOf(uint vertex) { return PositionList(frame.hairs[hair_slot].positions).at[vertex]; }
uint attributesOf(uint vertex) { return WordList(frame.hairs[hair_slot].attributes).at[vertex]; }

#endif
