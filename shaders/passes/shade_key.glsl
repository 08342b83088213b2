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
  return ShadeSource(frame.hairs[0], frameLight(), pixelRay(vec2(pixel) + 0.5), pixel);
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

// An aggregate at the middle of its depths, as a mean over tangents: of sin(T, L) over the sphere that is pi / 4.
vec3 shadeAggregate(Aggregate a, ShadeSource source) {
  HairConstants hair = hairOf(a.slot, source);
  vec3 around = ambientOn(vec3(0.0), source.light.ambient) * hair.diffuse * hair.color;
  vec3 whole = radianceLow(hair, hair.color, source.light, vec3(0.0), source.ray, 0.5 * (a.least + a.greatest), source.pixel);
  return around + 0.78539816 * (whole - around);
}

#endif
