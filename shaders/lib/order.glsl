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

// A step of inserting `added` into keys in order, the first of which is visited first: `held` takes what moves on, `added` at first.
// All comparisons are with the key that is added, so that none waits for another.
void keyInsert(inout Key here, inout Key held, Key added, bool one_hair, bool color) {
  bool moves = keyLess(added, here, one_hair, color);
  Key before = here;
  here.depth = moves ? held.depth : before.depth;
  here.payload = moves ? held.payload : before.payload;
  held.depth = moves ? before.depth : held.depth;
  held.payload = moves ? before.payload : held.payload;
  if (!one_hair) {
    here.slot = moves ? held.slot : before.slot;
    held.slot = moves ? before.slot : held.slot;
  }
  if (color) {
    here.color = moves ? held.color : before.color;
    held.color = moves ? before.color : held.color;
  }
}

#endif
