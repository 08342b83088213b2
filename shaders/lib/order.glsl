// Fragment keys (docs/methods.md section 3). A frame of one hair needs no slot in them, one without colours no colour: both come
// with a specialisation constant, so that they cost nothing there.
#ifndef FORELOCK_LIB_ORDER
#define FORELOCK_LIB_ORDER

// Depths are positive floats, whose bits sort as integers.
struct Key {
  uint depth;
  uint payload;
  uint slot;
  uint color;  // of the fibre; orders only what is otherwise equal, so that equal keys are equal fragments
};

const uint kDepthNone = 0xFFFFFFFFu;  // of no fragment: it would be NaN
Key keyNone() { return Key(kDepthNone, 0xFFFFFFFFu, 0u, 0u); }

bool keyLess(Key a, Key b, bool one_hair, bool color) {
  bool nearer_payload = a.payload < b.payload || (color && a.payload == b.payload && a.color < b.color);
  bool nearer = one_hair ? nearer_payload : a.slot < b.slot || (a.slot == b.slot && nearer_payload);
  return a.depth < b.depth || (a.depth == b.depth && nearer);
}

bool keyEqual(Key a, Key b, bool one_hair, bool color) {
  return a.depth == b.depth && a.payload == b.payload && (one_hair || a.slot == b.slot) && (!color || a.color == b.color);
}

// a and b in order.
void keySort(inout Key a, inout Key b, bool one_hair, bool color) {
  bool swap = keyLess(b, a, one_hair, color);
  Key first = a;
  a.depth = swap ? b.depth : a.depth;
  a.payload = swap ? b.payload : a.payload;
  b.depth = swap ? first.depth : b.depth;
  b.payload = swap ? first.payload : b.payload;
  if (!one_hair) {
    a.slot = swap ? b.slot : a.slot;
    b.slot = swap ? first.slot : b.slot;
  }
  if (color) {
    a.color = swap ? b.color : a.color;
    b.color = swap ? first.color : b.color;
  }
}

#endif
