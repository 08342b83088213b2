// A stored fragment to its colour: shading of what capture left for later. Included after list.glsl and light.glsl.
#ifndef FORELOCK_PASSES_SHADE_KEY
#define FORELOCK_PASSES_SHADE_KEY

// What all fragments of a pixel are shaded with, read once.
struct ShadeSource {
  HairConstants only;  // the hair of a frame of one
  FrameLight light;
  PixelRay ray;
  uvec2 pixel;         // of the target
};

ShadeSource shadeSource(uvec2 pixel) {
  return ShadeSource(frame.hairs[0], frameLight(pixel), pixelRay(vec2(pixel) + 0.5), pixel);
}

HairConstants hairOf(uint slot, ShadeSource source) {
  HairConstants hair = source.only;
  if (!kOneHair) hair = frame.hairs[slot];
  return hair;
}

vec3 shadeTangent(uint slot, vec3 tangent, float depth, uint color, ShadeSource source, bool full) {
  HairConstants hair = hairOf(slot, source);
  vec3 fibre = kColor ? unpackSharedExponent(color) : hair.color;
  return full ? radianceFull(hair, fibre, source.light, tangent, source.ray, depth, source.pixel)
              : radianceLow(hair, fibre, source.light, tangent, source.ray, depth, source.pixel);
}

vec3 shadeKey(Key key, ShadeSource source, bool full, out float alpha) {
  vec3 tangent;
  unpackTangent(key.payload, kPayload, tangent, alpha);
  return shadeTangent(key.slot, tangent, uintBitsToFloat(key.depth), key.color, source, full);
}

// An aggregate's nearest fragment, and the rest with its tangent at the mean depth at which it is seen: of a slab of optical depth x
// (natural) that is the share 1 / x - 1 / (e^x - 1) of the way through.
void shadeSlab(inout Slab slab, Aggregate a, ShadeSource source, bool full) {
  HairConstants hair = hairOf(a.slot, source);
  slab.nearest_color = full ? radianceFull(hair, hair.color, source.light, a.tangent, source.ray, a.least, source.pixel)
                            : radianceLow(hair, hair.color, source.light, a.tangent, source.ray, a.least, source.pixel);
  if (a.count < 2.0) return;
  float x = slab.tau * 0.69314718;
  float share = x > 0.01 ? 1.0 / x - 1.0 / (exp(min(x, 80.0)) - 1.0) : 0.5;
  float depth = mix(a.least, a.greatest, clamp(share, 0.0, 0.5));
  slab.color = full ? radianceFull(hair, hair.color, source.light, a.tangent, source.ray, depth, source.pixel)
                    : radianceLow(hair, hair.color, source.light, a.tangent, source.ray, depth, source.pixel);
}

#endif
