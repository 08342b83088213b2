// One invocation an item: IN words in, OUT words out (a test shader defines both). Words, not floats: a NaN or a
// denormal travels unchanged.
#ifndef FORELOCK_NUMERICS_ITEMS
#define FORELOCK_NUMERICS_ITEMS
layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer InBuffer { uint in_words[]; };
layout(set = 0, binding = 1) writeonly buffer OutBuffer { uint out_words[]; };
layout(push_constant) uniform PushConstants { uint item_count; };

uint itemIndex() { return gl_GlobalInvocationID.x; }
bool noItem() { return itemIndex() >= item_count; }
float in1(uint i) { return uintBitsToFloat(in_words[itemIndex() * IN + i]); }
vec2 in2(uint i) { return vec2(in1(i), in1(i + 1)); }
vec3 in3(uint i) { return vec3(in1(i), in1(i + 1), in1(i + 2)); }
void outWord(uint i, uint v) { out_words[itemIndex() * OUT + i] = v; }
void out1(uint i, float v) { outWord(i, floatBitsToUint(v)); }
void out2(uint i, vec2 v) { out1(i, v.x); out1(i + 1, v.y); }
void out3(uint i, vec3 v) { out2(i, v.xy); out1(i + 2, v.z); }

#endif
