// A strand segment to a quad of the screen: four vertices a segment, two triangles of an index buffer. docs/methods.md section 1.
#version 460
#extension GL_GOOGLE_include_directive : require
#define FLK_BIND_HAIR
#include "bindings.glsl"
#include "../lib/projection.glsl"
#include "../lib/strand_quad.glsl"
#include "../lib/strand_vertex.glsl"

layout(location = 0) flat out vec4 out_axis;      // a.xy, b.xy (pixel from the middle of the target)
layout(location = 1) flat out vec4 out_lines;     // normals of the lines that end the quad at a, at b
layout(location = 2) flat out vec4 out_extent;    // half widths, distances to the strand's root and tip (pixel)
layout(location = 3) flat out vec4 out_depth;     // depths (metre), fractions
layout(location = 4) flat out vec4 out_tangent_a; // tangent at a, strand hash
layout(location = 5) flat out vec4 out_tangent_b; // tangent at b, length (pixel)
layout(location = 6) flat out vec2 out_direction; // unit, a to b
layout(location = 7) flat out vec3 out_joint;     // slopes of those lines, share of the opacity

vec3 viewPosition(uint vertex) { return frame.hairs[hair_slot].view_from_hair * vec4(positions[vertex], 1.0); }

vec2 toPixel(vec3 p) { return projectToPixel(p, frame.proj_scale, frame.proj_offset, frame.orthographic, frame.size); }

float depthOf(vec3 p) { return -p.z; }

// Half width at a point of view space, across direction t.
float pixelHalfWidth(float radius, vec3 p, vec2 t) {
  return halfWidth(radius, frame.pixels_per_unit / (frame.orthographic > 0.5 ? 1.0 : depthOf(p)), t);
}

vec3 viewDelta(uint from, uint to) { return mat3(frame.hairs[hair_slot].view_from_hair) * (positions[to] - positions[from]); }

// Share of d from p, which is not before the near plane, that is not either.
float visibleShare(vec3 p, vec3 d) {
  return depthOf(p + d) >= frame.near_plane ? 1.0 : (depthOf(p) - frame.near_plane) / d.z;  // d.z > 0: it comes nearer
}

FlatSegment toFlat(vec3 a, vec3 b, vec3 d) {
  return flatSegment(toPixel(a), toPixel(b), projectDelta(a, d, frame.proj_scale, frame.orthographic, frame.size));
}

void main() {
  uint word = segments[gl_VertexIndex >> 2];
  float side = (gl_VertexIndex & 1) == 0 ? -1.0 : 1.0;
  bool at_b = (gl_VertexIndex & 2) != 0;
  uint ia = word & FLK_SEGMENT_VERTEX_MASK;
  bool root = (word & FLK_SEGMENT_ROOT) != 0u, tip = (word & FLK_SEGMENT_TIP) != 0u;

  vec3 a = viewPosition(ia), b = viewPosition(ia + 1);
  vec3 d = viewDelta(ia, ia + 1);
  vec3 d_before = root ? vec3(0.0) : viewDelta(ia - 1, ia), d_after = tip ? vec3(0.0) : viewDelta(ia + 1, ia + 2);
  uint wa = attributes[ia], wb = attributes[ia + 1];
  float radius_max = frame.hairs[hair_slot].radius_max;
  vec2 at_a = vec2(attributeRadius(wa, radius_max), attributeFraction(wa));
  vec2 at_b_end = vec2(attributeRadius(wb, radius_max), attributeFraction(wb));

  vec3 own = unitOrZero(d);
  vec3 tangent_a = vertexTangent(unitOrZero(d_before), own, own);
  vec3 tangent_b = vertexTangent(own, unitOrZero(d_after), own);

  // Near plane.
  bool hidden = depthOf(a) < frame.near_plane && depthOf(b) < frame.near_plane;
  bool cut_a = depthOf(a) < frame.near_plane, cut_b = depthOf(b) < frame.near_plane;
  if (!hidden && (cut_a || cut_b)) {
    float u = cut_a ? 1.0 - visibleShare(b, -d) : visibleShare(a, d);
    vec3 p = vec3(mix(a.xy, b.xy, u), -frame.near_plane);
    d *= cut_a ? 1.0 - u : u;
    vec2 cut = mix(at_a, at_b_end, u);
    vec3 tangent = mix(tangent_a, tangent_b, u);
    if (cut_a) { a = p; at_a = cut; tangent_a = tangent; }
    else { b = p; at_b_end = cut; tangent_b = tangent; }
  }

  FlatSegment segment = toFlat(a, b, d);
  gl_Position = vec4(-2.0, -2.0, 0.0, 1.0);  // four equal corners: nothing is drawn
  if (hidden || !(segment.l > 0.0)) return;

  float extent = pixelHalfExtent(segment.t);  // also of the pixel along t: |n.x| = |t.y|
  float ha = pixelHalfWidth(at_a.x, a, segment.t), hb = pixelHalfWidth(at_b_end.x, b, segment.t);
  float on_a = root && !cut_a ? extent : 0.0, on_b = tip && !cut_b ? extent : 0.0;  // past the strand's own ends

  QuadEnd end_a, end_b;
  d_before *= visibleShare(a, -d_before);
  FlatSegment other = toFlat(a - d_before, a, d_before);
  if (root || cut_a || !(other.l > 0.0)) {
    end_a = freeEnd(segment.a, side, ha + extent, segment.t, -1.0, on_a, !(on_a > 0.0));
  } else {
    float h_other = pixelHalfWidth(at_a.x, a, other.t);
    end_a = jointEnd(segment.a, side, max(ha + extent, h_other + pixelHalfExtent(other.t)), other, segment, false);
  }
  d_after *= visibleShare(b, d_after);
  other = toFlat(b, b + d_after, d_after);
  if (tip || cut_b || !(other.l > 0.0)) {
    end_b = freeEnd(segment.b, side, hb + extent, segment.t, 1.0, on_b, !(on_b > 0.0));
  } else {
    float h_other = pixelHalfWidth(at_b_end.x, b, other.t);
    end_b = jointEnd(segment.b, side, max(hb + extent, h_other + pixelHalfExtent(other.t)), segment, other, true);
  }

  gl_Position = vec4((at_b ? end_b.corner : end_a.corner) / frame.size * 2.0, 0.0, 1.0);
  out_axis = vec4(segment.a, segment.b);
  out_lines = vec4(end_a.line, end_b.line);
  // Distances to the strand's ends, as if all of it ran as this segment does; a segment that the fraction's steps do not tell
  // from a point counts as one step long.
  float pixels_per_fraction = segment.l / max(at_b_end.y - at_a.y, 1.0 / FLK_FRACTION_STEPS);
  out_extent = vec4(ha, hb, at_a.y * pixels_per_fraction, (1.0 - at_b_end.y) * pixels_per_fraction);
  out_depth = vec4(depthOf(a), depthOf(b), at_a.y, at_b_end.y);
  out_tangent_a = vec4(tangent_a, float(attributeHash(wa)));
  out_tangent_b = vec4(tangent_b, segment.l);
  out_direction = segment.t;
  out_joint = vec3(end_a.slope, end_b.slope,
                   areaShare(segment, 0.5 * (ha + hb), end_a.slope + end_b.slope, vec2(on_a, on_b), out_extent.zw));
}
