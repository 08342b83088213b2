// Light that gets past meshes and hair to a point of a mesh. SPDX-License-Identifier: MIT

layout(set = 0, binding = 0) uniform sampler2D hair_map;
layout(set = 0, binding = 1) uniform sampler2DArray mesh_maps;

const float kAround = 32.0;  // texels around a map: points beyond are asked for there, so that loops over texels end
const vec2 kCorners[4] = vec2[4](vec2(0, 1), vec2(1, 1), vec2(1, 0), vec2(0, 0));  // as textureGather gives them

// How far the four texels from `first` on are from `centre` (texel), both in coordinates of texel centres.
vec4 distances(vec2 first, vec2 centre) {
  vec2 d = first - centre;
  vec4 x = d.x + vec4(kCorners[0].x, kCorners[1].x, kCorners[2].x, kCorners[3].x);
  vec4 y = d.y + vec4(kCorners[0].y, kCorners[1].y, kCorners[2].y, kCorners[3].y);
  return sqrt(x * x + y * y);
}

// Share of a light that the meshes let through: a disc of 3 mm of their map, weighed to its rim, so that no texel shows. The point is
// lifted off its surface as far as the surface rises over the disc.
float pastMeshes(LightConstants light, float behind, vec3 p, vec3 normal, float facing) {
  vec4 source = vec4(light.placed != 0 ? light.position : light.to_light, float(light.placed));
  float texel = light.texel;
  if (light.placed != 0) {
    texel *= max((light.map_from_world * vec4(p, 1.0)).w, 1e-6);
  }
  float radius = clamp(0.003 / texel, 1.5, 8.0);
  vec3 lifted = p + normal * (0.0005 + radius * texel * sqrt(max(1.0 - facing * facing, 0.0)));
  vec4 at = light.map_from_world * vec4(lifted + behind * awayFrom(source, lifted), 1.0);
  if (at.w <= 0.0) {
    return 1.0;
  }
  at.xyz /= at.w;
  float size = float(textureSize(mesh_maps, 0).x);
  vec2 centre = clamp(at.xy - 0.5, vec2(-kAround), vec2(size + kAround));
  vec2 first = floor(centre - radius);
  float lit = 0.0, sum = 0.0;
  for (float y = first.y; y <= centre.y + radius; y += 2.0) {
    for (float x = first.x; x <= centre.x + radius; x += 2.0) {
      vec4 d = distances(vec2(x, y), centre) / radius;
      vec4 weight = max(1.0 - d * d, vec4(0.0));
      vec4 value = textureGather(mesh_maps, vec3(vec2(x + 1.0, y + 1.0) / size, float(light.layer)));
      lit += dot(weight, step(vec4(at.z), value));
      sum += dot(weight, vec4(1.0));
    }
  }
  return lit / max(sum, 1e-6);  // the radius is more than a texel: something is in the disc
}

// docs/methods.md section 4 for a point of a mesh, averaged over a disc of 4 mm: the map's strands are a texel wide and would draw their
// pattern on the skin. `extinction`: what is lost of the light (log2, 1/m).
float pastHair(LightConstants light, vec3 p, float extinction) {
  uint face = light.first_face;
  vec4 at = push.faces.at[face].texels_from_world * vec4(p, 1.0);
  for (uint i = 1; i < light.face_count; ++i) {  // of six the one that the point lies before
    vec4 there = push.faces.at[light.first_face + i].texels_from_world * vec4(p, 1.0);
    if (there.z > at.z) {
      face = light.first_face + i;
      at = there;
    }
  }
  FaceConstants map = push.faces.at[face];
  float texel = map.texel;
  float distance = at.z;
  if (map.perspective != 0) {
    if (at.z <= 0.0) {
      return 1.0;
    }
    texel *= at.z;
    distance = length(p - light.position);
    at.xy /= at.w;
  }
  float radius = clamp(0.004 / texel, 2.0, 16.0);
  float size = float(map.size);
  vec2 centre = clamp(at.xy - 0.5, vec2(-kAround), vec2(size + kAround));
  vec2 first = floor(centre - radius - 0.5);
  vec2 image = vec2(textureSize(hair_map, 0));
  float lit = 0.0, sum = 0.0;
  for (float y = first.y; y <= centre.y + radius + 0.5; y += 2.0) {
    for (float x = first.x; x <= centre.x + radius + 0.5; x += 2.0) {
      vec4 weight = clamp(radius + 0.5 - distances(vec2(x, y), centre), vec4(0.0), vec4(1.0));
      vec4 front = textureGather(hair_map, (vec2(map.offset) + vec2(x, y) + 1.0) / image);
      vec4 column = x + vec4(kCorners[0].x, kCorners[1].x, kCorners[2].x, kCorners[3].x);
      vec4 row = y + vec4(kCorners[0].y, kCorners[1].y, kCorners[2].y, kCorners[3].y);
      vec4 low = min(column, row), high = max(column, row);
      bvec4 empty = bvec4(uvec4(lessThan(low, vec4(0.0))) | uvec4(greaterThanEqual(high, vec4(size))) | uvec4(greaterThanEqual(front, vec4(1.0))));
      vec4 behind = mix(max(distance - front * map.depth_range, vec4(0.0)), vec4(0.0), empty);
      lit += dot(weight, exp2(-behind * extinction));
      sum += dot(weight, vec4(1.0));
    }
  }
  return lit / max(sum, 1e-6);
}
