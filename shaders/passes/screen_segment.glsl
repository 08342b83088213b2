// A strand segment as a quad of the screen (docs/methods.md section 1), for capture by either rasteriser.
// Included after bindings.glsl.
#ifndef FORELOCK_PASSES_SCREEN_SEGMENT
#define FORELOCK_PASSES_SCREEN_SEGMENT
#include "../lib/packing.glsl"
#include "../lib/projection.glsl"
#include "../lib/strand_quad.glsl"
#include "segment_input.glsl"

layout(constant_id = FLK_SPEC_COLOR) const bool kColor = false;

// What the fragments of a quad share. Pixels count from the middle of the target, where fp32 is finest.
struct SegmentShape {
  vec4 axis;       // a.xy, b.xy (pixel)
  vec4 lines;      // normals of the lines that end the quad at a, at b
  vec4 extent;     // half widths, distances to the strand's root and tip (pixel)
  vec4 depth;      // depths (metre; perspective: their inverses), fractions
  vec4 tangent_a;  // tangent at a, strand hash
  vec4 tangent_b;  // tangent at b, length (pixel)
  vec2 direction;  // unit, a to b
  vec3 joint;      // slopes of those lines, share of the opacity
};

// Vertex colours of its ends, with kColor.
struct FibreColors {
  vec3 a, b;
};

vec3 viewPosition(uint vertex) { return frame.hairs[hair_slot].view_from_hair * vec4(positionOf(vertex), 1.0); }

vec2 toPixel(vec3 p) { return projectToPixel(p, frame.proj_scale, frame.proj_offset, frame.orthographic, frame.size); }

float depthOf(vec3 p) { return -p.z; }

// Half width at a point of view space, across direction t.
float pixelHalfWidth(float radius, vec3 p, vec2 t) {
  return halfWidth(radius, frame.pixels_per_unit / (frame.orthographic > 0.5 ? 1.0 : depthOf(p)), t);
}

vec3 viewDelta(uint from, uint to) { return mat3(frame.hairs[hair_slot].view_from_hair) * (positionOf(to) - positionOf(from)); }

// Share of d from p, which is not before the near plane, that is not either.
float visibleShare(vec3 p, vec3 d) {
  return depthOf(p + d) >= frame.near_plane ? 1.0 : (depthOf(p) - frame.near_plane) / d.z;  // d.z > 0: it comes nearer
}

FlatSegment toFlat(vec3 a, vec3 b, vec3 d) {
  return flatSegment(toPixel(a), toPixel(b), projectDelta(a, d, frame.proj_scale, frame.orthographic, frame.size));
}

vec3 vertexColor(uint vertex) {
  uvec2 colors = frame.hairs[hair_slot].colors;
  return colors == uvec2(0u) ? vec3(1.0) : unpackSharedExponent(WordList(colors).at[vertex]);
}

// Of the fibre where the strand's arc length has the share `fraction` behind it, along: the segment.
vec3 fibreColor(FibreColors ends, float along, float fraction) {
  vec3 base = mix(frame.hairs[hair_slot].color, frame.hairs[hair_slot].tip_color, frame.hairs[hair_slot].tip_blend * fraction);
  return base * mix(ends.a, ends.b, along);
}

// False: it makes no quad.
bool segmentShape(uint index, out SegmentShape shape, out FibreColors colors, out QuadEnd end_a, out QuadEnd end_b) {
  Segment source = readSegment(index);
  uint ia = source.vertex;
  vec3 a = viewPosition(ia), b = viewPosition(ia + 1u);
  vec3 d = viewDelta(ia, ia + 1u);
  vec3 d_before = source.root ? vec3(0.0) : viewDelta(ia - 1u, ia), d_after = source.tip ? vec3(0.0) : viewDelta(ia + 1u, ia + 2u);
  uint wa = attributesOf(ia), wb = attributesOf(ia + 1u);
  float radius_max = frame.hairs[hair_slot].radius_max;
  vec2 at_a = vec2(attributeRadius(wa, radius_max), attributeFraction(wa));
  vec2 at_b = vec2(attributeRadius(wb, radius_max), attributeFraction(wb));
  if (kColor) colors.a = vertexColor(ia), colors.b = vertexColor(ia + 1u);

  vec3 own = unitOrZero(d);
  vec3 tangent_a = vertexTangent(unitOrZero(d_before), own, own);
  vec3 tangent_b = vertexTangent(own, unitOrZero(d_after), own);

  // Near plane.
  bool cut_a = depthOf(a) < frame.near_plane, cut_b = depthOf(b) < frame.near_plane;
  if (cut_a && cut_b) return false;
  if (cut_a || cut_b) {
    float u = cut_a ? 1.0 - visibleShare(b, -d) : visibleShare(a, d);
    vec3 p = vec3(mix(a.xy, b.xy, u), -frame.near_plane);
    d *= cut_a ? 1.0 - u : u;
    vec2 cut = mix(at_a, at_b, u);
    vec3 tangent = mix(tangent_a, tangent_b, u);
    vec3 color = kColor ? mix(colors.a, colors.b, u) : vec3(0.0);
    if (cut_a) { a = p; at_a = cut; tangent_a = tangent; if (kColor) colors.a = color; }
    else { b = p; at_b = cut; tangent_b = tangent; if (kColor) colors.b = color; }
  }

  FlatSegment segment = toFlat(a, b, d);
  if (!(segment.l > 0.0)) return false;

  float extent = pixelHalfExtent(segment.t);  // also of the pixel along t: |n.x| = |t.y|
  float ha = pixelHalfWidth(at_a.x, a, segment.t), hb = pixelHalfWidth(at_b.x, b, segment.t);
  float on_a = source.root && !cut_a ? extent : 0.0, on_b = source.tip && !cut_b ? extent : 0.0;  // past the strand's own ends

  d_before *= visibleShare(a, -d_before);
  FlatSegment other = toFlat(a - d_before, a, d_before);
  if (source.root || cut_a || !(other.l > 0.0)) {
    end_a = freeEnd(segment.a, ha + extent, segment.t, -1.0, on_a, !(on_a > 0.0));
  } else {
    float h_other = pixelHalfWidth(at_a.x, a, other.t);
    end_a = jointEnd(segment.a, max(ha + extent, h_other + pixelHalfExtent(other.t)), other, segment, false);
  }
  d_after *= visibleShare(b, d_after);
  other = toFlat(b, b + d_after, d_after);
  if (source.tip || cut_b || !(other.l > 0.0)) {
    end_b = freeEnd(segment.b, hb + extent, segment.t, 1.0, on_b, !(on_b > 0.0));
  } else {
    float h_other = pixelHalfWidth(at_b.x, b, other.t);
    end_b = jointEnd(segment.b, max(hb + extent, h_other + pixelHalfExtent(other.t)), segment, other, true);
  }

  shape.axis = vec4(segment.a, segment.b);
  shape.lines = vec4(end_a.line, end_b.line);
  // Distances to the strand's ends, as if all of it ran as this segment does; a segment that the fraction's steps do not tell
  // from a point counts as one step long.
  float pixels_per_fraction = segment.l / max(at_b.y - at_a.y, 1.0 / FLK_FRACTION_STEPS);
  shape.extent = vec4(ha, hb, at_a.y * pixels_per_fraction, (1.0 - at_b.y) * pixels_per_fraction);
  vec2 depths = vec2(depthOf(a), depthOf(b));
  shape.depth = vec4(frame.orthographic > 0.5 ? depths : 1.0 / depths, at_a.y, at_b.y);
  shape.tangent_a = vec4(tangent_a, float(attributeHash(wa)));
  shape.tangent_b = vec4(tangent_b, segment.l);
  shape.direction = segment.t;
  shape.joint = vec3(end_a.slope, end_b.slope,
                     areaShare(segment, 0.5 * (ha + hb), end_a.slope + end_b.slope, vec2(on_a, on_b), shape.extent.zw));
  return true;
}

#endif
