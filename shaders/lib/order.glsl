// Fragment keys and the sorted front of a list (docs/methods.md sections 3 and 6).
#ifndef FORELOCK_LIB_ORDER
#define FORELOCK_LIB_ORDER

// x: depth bits, y: slot, z: payload. Depths are positive floats, whose bits sort as integers.
bool keyLess(uvec3 a, uvec3 b) {
  return a.x < b.x || (a.x == b.x && (a.y < b.y || (a.y == b.y && a.z < b.z)));
}

const uvec3 kKeyNone = uvec3(0xFFFFFFFFu);  // no fragment: its depth would be NaN

#endif
