// Colours for FLK_DISPLAY_...
#ifndef FORELOCK_LIB_DISPLAY
#define FORELOCK_LIB_DISPLAY
#define FLK_SHOW_STRAND 1
#define FLK_SHOW_ROOT_TIP 2
#define FLK_SHOW_WIDTH 3
#define FLK_SHOW_DEPTH 4
#define FLK_SHOW_LAYERS 5

vec3 hueColor(float hue) {
  return clamp(abs(fract(hue + vec3(0.0, 2.0 / 3.0, 1.0 / 3.0)) * 6.0 - 3.0) - 1.0, 0.0, 1.0);
}

vec3 strandColor(uint hash) {
  float hue = float(hash & 7u) / 8.0, level = float(hash >> 3 & 3u) / 3.0;
  return mix(vec3(0.6), hueColor(hue), 0.75) * (0.25 + 0.6 * level);
}

vec3 rootTipColor(float fraction) { return mix(vec3(0.02, 0.05, 0.35), vec3(1.0, 0.75, 0.1), clamp(fraction, 0.0, 1.0)); }

// Blue 1/8 pixel and below, green 1, red 8 and above.
vec3 widthColor(float width_px) {
  float x = clamp(log2(max(width_px, 1e-6)) / 3.0, -1.0, 1.0);
  vec3 green = vec3(0.05, 0.7, 0.1);
  return x < 0.0 ? mix(green, vec3(0.05, 0.1, 0.9), -x) : mix(green, vec3(0.9, 0.05, 0.02), x);
}

vec3 depthColor(float depth, vec2 range) {
  float x = clamp((depth - range.x) / max(range.y - range.x, 1e-6), 0.0, 1.0);
  float near = 1.0 - x;
  return vec3(0.01 + 0.89 * near * near * near);  // steps of depth look equal after a display's gamma
}

// The paper's Figure 2: grey 1, blue 8, green 50, red 100 and above.
vec3 layersColor(uint count) {
  float n = float(count);
  vec3 grey = vec3(0.5), blue = vec3(0.05, 0.1, 0.9), green = vec3(0.05, 0.7, 0.1), red = vec3(0.9, 0.05, 0.02);
  if (n <= 8.0) return mix(grey, blue, (n - 1.0) / 7.0);
  if (n <= 50.0) return mix(blue, green, (n - 8.0) / 42.0);
  return mix(green, red, clamp((n - 50.0) / 50.0, 0.0, 1.0));
}

#endif
