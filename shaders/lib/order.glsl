// Fragment keys (docs/methods.md section 3). A frame of one hair needs no slot in them: kOneHair is a specialisation constant,
// so that the slot costs nothing there.
#ifndef FORELOCK_LIB_ORDER
#define FORELOCK_LIB_ORDER

// Depths are positive floats, whose bits sort as integers.
struct Key {
  uint depth;
  uint payload;
  uint slot;
};

const uint kDepthNone = 0xFFFFFFFFu;  // of no fragment: it would be NaN
Key keyNone() { return Key(kDepthNone, 0xFFFFFFFFu, 0u); }

bool keyLess(Key a, Key b, bool one_hair) {
  bool nearer_payload = one_hair ? a.payload < b.payload : a.slot < b.slot || (a.slot == b.slot && a.payload < b.payload);
  return a.depth < b.depth || (a.depth == b.depth && nearer_payload);
}

bool keyEqual(Key a, Key b, bool one_hair) { return a.depth == b.depth && a.payload == b.payload && (one_hair || a.slot == b.slot); }

// a and b in order.
void keySort(inout Key a, inout Key b, bool one_hair) {
  bool swap = keyLess(b, a, one_hair);
  Key first = a;
  a.depth = swap ? b.depth : a.depth;
  a.payload = swap ? b.payload : a.payload;
  b.depth = swap ? first.depth : b.depth;
  b.payload = swap ? first.payload : b.payload;
  if (!one_hair) {
    a.slot = swap ? b.slot : a.slot;
    b.slot = swap ? first.slot : b.slot;
  }
}

#endif
