// Exact area of a pixel under a strip (docs/methods.md section 2).
#ifndef FORELOCK_LIB_COVERAGE
#define FORELOCK_LIB_COVERAGE

// Half the extent of a unit pixel along a unit direction.
float pixelHalfExtent(vec2 direction) { return 0.5 * (abs(direction.x) + abs(direction.y)); }

// A pixel seen across lines of one direction; a >= b >= 0 are the absolute components of their unit normal.
struct PixelBox {
  float flat_part;        // half the width of its middle, where its extent along the lines does not change
  float reach;            // half its width
  float inverse_a;        // a >= 1/sqrt(2)
  float inverse_corner;   // 1 / (2 a b); b may be 0: then the flat part ends where the reach does
};

PixelBox pixelBox(float a, float b) { return PixelBox(0.5 * (a - b), 0.5 * (a + b), 1.0 / a, 1.0 / max(2.0 * a * b, 1e-30)); }

// Area of the pixel on one side of a line at signed distance t, less one half.
float boxEdge(float t, PixelBox box) {
  float s = abs(t), rest = max(box.reach - s, 0.0);
  float r = s <= box.flat_part ? s * box.inverse_a : 0.5 - rest * rest * box.inverse_corner;
  return t < 0.0 ? -r : r;
}

float boxEdge(float t, float a, float b) { return boxEdge(t, pixelBox(a, b)); }

// Integral of boxEdge + 1/2 up to t.
float boxEdgeSum(float t, float a, float b) {
  float s = abs(t);
  float rest = 0.5 * (a + b) - s;
  float r = 0.0;
  if (s <= 0.5 * (a - b)) r = (3.0 * a * a + b * b) / (24.0 * a) - 0.5 * s + s * s / (2.0 * a);
  else if (rest > 0.0) r = rest * rest * rest / max(6.0 * a * b, 1e-30);
  return t > 0.0 ? t + r : r;
}

// Integral of that, up to -t.
float boxEdgeBeyond(float t, float a, float b) {
  float s = abs(t);
  float rest = 0.5 * (a + b) - s;
  float r = 0.0;
  if (s <= 0.5 * (a - b)) r = 1.0 / 48.0 - s * ((3.0 * a * a + b * b) / (24.0 * a) - s * (0.25 - s / (6.0 * a)));
  else if (rest > 0.0) r = rest * rest * rest * rest / max(24.0 * a * b, 1e-30);
  return t < 0.0 ? 0.5 * t * t + 1.0 / 24.0 - r : r;
}

#endif
