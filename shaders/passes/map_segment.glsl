// A strand segment as a quad of a shadow map, at least one texel wide (docs/methods.md section 4), for either rasteriser.
// Included after bindings.glsl. FLK_COVER_WIDTH: for frames with maps in which a strand keeps a share of its texels.
#ifndef FORELOCK_PASSES_MAP_SEGMENT
#define FORELOCK_PASSES_MAP_SEGMENT
#include "../lib/strand_quad.glsl"
#include "segment_input.glsl"
#ifdef FLK_COVER_WIDTH
#include "../lib/shadow_cover.glsl"
#define FLK_FACE (face & ~FLK_FACE_BY_WIDTH)
#else
#define FLK_FACE face
#endif

layout(constant_id = FLK_SPEC_FACES) const uint kFaces = uint(FLK_FACES_ORTHOGRAPHIC);

struct MapShape {
  vec4 axis;       // a.xy, b.xy (texel from the middle of the map)
  vec4 lines;      // normals of the lines that end the quad
  vec4 depth;      // depths (metre; perspective: along the axis), half widths (texel)
  vec3 direction;  // unit, a to b; length (texel)
  vec3 face;       // focal length (0: orthographic), metre of a full depth value, half a side (texel)
#ifdef FLK_COVER_WIDTH
  vec2 cover;      // half widths (texel) that would cover as much if they were opaque
  uint seed;       // of the texels that are kept
#endif
};

// map_from_hair: texels from the map's middle and metre, or in perspective metre in the light's axes.
vec3 mapPosition(uint vertex) { return map_from_hair * vec4(positionOf(vertex), 1.0); }
vec3 mapDelta(uint from, uint to) { return mat3(map_from_hair) * (positionOf(to) - positionOf(from)); }

vec2 toTexel(vec3 p, float focal) { return focal > 0.0 ? p.xy / p.z * focal : p.xy; }
// From the texel of p to that of p + d, without the cancellation of two projections.
vec2 toTexelDelta(vec3 p, vec3 d, float focal) { return focal > 0.0 ? (d.xy - p.xy * (d.z / p.z)) * focal / (p.z + d.z) : d.xy; }

float texelHalfWidth(float radius, float z, FaceConstants f) { return max(radius / (f.focal > 0.0 ? f.texel * z : f.texel), 0.5); }

// Share of d from p, which is not before the near plane, that is not either.
float litShare(vec3 p, vec3 d, FaceConstants f) {
  return f.focal == 0.0 || p.z + d.z >= f.near ? 1.0 : (p.z - f.near) / -d.z;  // d.z < 0: it comes nearer
}

FlatSegment toFlatMap(vec3 a, vec3 b, vec3 d, float focal) { return flatSegment(toTexel(a, focal), toTexel(b, focal), toTexelDelta(a, d, focal)); }

// False: it makes no quad.
bool mapShape(uint index, out MapShape shape, out QuadEnd end_a, out QuadEnd end_b) {
  FaceConstants f = FaceList(frame.faces).at[FLK_FACE];
  if ((kFaces & ~uint(FLK_FACES_ORTHOGRAPHIC)) == 0u) f.focal = 0.0;
  Segment source = readSegment(index);
  uint ia = source.vertex;
  vec3 a = mapPosition(ia), b = mapPosition(ia + 1u), d = mapDelta(ia, ia + 1u);
  vec3 d_before = source.root ? vec3(0.0) : mapDelta(ia - 1u, ia), d_after = source.tip ? vec3(0.0) : mapDelta(ia + 1u, ia + 2u);
  float radius_max = frame.hairs[hair_slot].radius_max;
  float ra = attributeRadius(attributesOf(ia), radius_max), rb = attributeRadius(attributesOf(ia + 1u), radius_max);
#ifdef FLK_COVER_WIDTH
  vec2 along = vec2(attributeFraction(attributesOf(ia)), attributeFraction(attributesOf(ia + 1u)));
  vec2 opacity = mix(vec2(frame.hairs[hair_slot].opacity_root), vec2(frame.hairs[hair_slot].opacity_tip), along);
#endif
  bool cut_a = false, cut_b = false;
  if (f.focal > 0.0) {
    cut_a = a.z < f.near, cut_b = b.z < f.near;
    if (cut_a && cut_b) return false;
    if (cut_a || cut_b) {
      float u = cut_a ? 1.0 - litShare(b, -d, f) : litShare(a, d, f);
      vec3 p = vec3(mix(a.xy, b.xy, u), f.near);
      float r = mix(ra, rb, u);
#ifdef FLK_COVER_WIDTH
      if (cut_a) opacity.x = mix(opacity.x, opacity.y, u);
      else opacity.y = mix(opacity.x, opacity.y, u);
#endif
      d *= cut_a ? 1.0 - u : u;
      if (cut_a) a = p, ra = r;
      else b = p, rb = r;
    }
  }
  FlatSegment segment = toFlatMap(a, b, d, f.focal);
  if (!(segment.l > 0.0)) return false;

  float ha = texelHalfWidth(ra, a.z, f), hb = texelHalfWidth(rb, b.z, f);
  d_before *= litShare(a, -d_before, f);
  FlatSegment other = toFlatMap(a - d_before, a, d_before, f.focal);
  if (source.root || cut_a || !(other.l > 0.0)) end_a = freeEnd(segment.a, ha, segment.t, -1.0, 0.0, true);
  else end_a = jointEnd(segment.a, ha, other, segment, false);
  d_after *= litShare(b, d_after, f);
  other = toFlatMap(b, b + d_after, d_after, f.focal);
  if (source.tip || cut_b || !(other.l > 0.0)) end_b = freeEnd(segment.b, hb, segment.t, 1.0, 0.0, true);
  else end_b = jointEnd(segment.b, hb, segment, other, true);
  shape.axis = vec4(segment.a, segment.b);
  shape.lines = vec4(end_a.line, end_b.line);
  shape.depth = vec4(a.z, b.z, ha, hb);
  shape.direction = vec3(segment.t, segment.l);
  shape.face = vec3(f.focal, f.range, float(f.size) * 0.5);
#ifdef FLK_COVER_WIDTH
  shape.cover = opacity * vec2(ra, rb) / (f.focal > 0.0 ? f.texel * vec2(a.z, b.z) : vec2(f.texel));
  if ((face & FLK_FACE_BY_WIDTH) == 0u) shape.cover = 2.0 * vec2(ha, hb);  // more than the whole texel: always kept
  shape.seed = coverSeed(ia, hair_slot);
#endif
  return true;
}

// What a texel of the quad holds, in [0, 1]; false: it lies outside. center: of the texel, from the middle of the map.
bool mapDepth(MapShape shape, vec2 center, out float value) {
  vec2 r = center - shape.axis.xy;
  float v = clamp(dot(r, shape.direction.xy) / shape.direction.z, 0.0, 1.0);
  float x = dot(r, leftNormal(shape.direction.xy));
  float focal = (kFaces & ~uint(FLK_FACES_ORTHOGRAPHIC)) != 0u ? shape.face.x : 0.0;
  float depth = mix(shape.depth.x, shape.depth.y, v);
  if (focal > 0.0) {
    float z = 1.0 / mix(1.0 / shape.depth.x, 1.0 / shape.depth.y, v);  // depths >= near > 0
    vec2 at = mix(shape.axis.xy, shape.axis.zw, v) / focal;
    depth = z * sqrt(1.0 + dot(at, at));
  }
  value = clamp(depth / shape.face.y, 0.0, 1.0);
#ifdef FLK_COVER_WIDTH
  float share = mix(shape.cover.x, shape.cover.y, v) / mix(shape.depth.z, shape.depth.w, v);  // drawn half widths >= 1/2
  if (!coverKeeps(shape.seed, uvec2(center + shape.face.z), share)) return false;
#endif
  return abs(x) <= mix(shape.depth.z, shape.depth.w, v) &&
         betweenLines(center, shape.axis.xy, shape.axis.zw, shape.lines.xy, shape.lines.zw);
}

#endif
