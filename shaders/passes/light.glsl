// The frame's light on a fragment. Included after bindings.glsl; FLK_BIND_SHADOW where a light casts hair shadows,
// FLK_BIND_HOST_LIGHT where the host has shadows of its own. What a frame does not have is folded away by constants.
#ifndef FORELOCK_PASSES_LIGHT
#define FORELOCK_PASSES_LIGHT
#extension GL_KHR_shader_subgroup_ballot : require

layout(constant_id = FLK_SPEC_LIGHTS) const int kLights = FLK_LIGHTS_SUN;
layout(constant_id = FLK_SPEC_LIGHT_KINDS) const uint kLightKinds = 1u;
layout(constant_id = FLK_SPEC_FACES) const uint kFaces = uint(FLK_FACES_ORTHOGRAPHIC);
layout(constant_id = FLK_SPEC_HOST) const uint kHost = 0u;
layout(constant_id = FLK_SPEC_AMBIENT) const bool kAmbient = false;
layout(constant_id = FLK_SPEC_COUNT_WORK) const bool kCountWork = false;
layout(constant_id = FLK_SPEC_TAPS) const uint kTaps = 25u;
layout(constant_id = FLK_SPEC_LOW_SHADE) const int kLowShade = FLK_LOW_PLAIN;
layout(constant_id = FLK_SPEC_LOCKSTEP) const bool kLockstep = false;

// For loops that are tested at their end. Where the test comes first, lavapipe (Mesa 22.3.6) runs a body once more with all lanes off, and
// a single light would cost two; but what a body computes, it gives to lanes that have left the loop as well, so they leave together.
bool anyLane(bool more) { return kLockstep ? subgroupBallot(more) != uvec4(0u) : more; }

// What this invocation did, for kCountWork.
uint full_shades = 0u, low_shades = 0u, shadow_taps = 0u;

#ifdef FLK_BIND_LISTS
void addWork() {
  if (!kCountWork) return;
  atomicAdd(counters[FLK_COUNTER_FULL], full_shades);
  atomicAdd(counters[FLK_COUNTER_LOW], low_shades);
  uint before = atomicAdd(counters[FLK_COUNTER_TAPS], shadow_taps);
  if (before + shadow_taps < before) atomicAdd(counters[FLK_COUNTER_TAPS + 1], 1u);
}
#endif

// What the fragments of a pixel share of the frame's light, read once before a loop over them begins.
struct FrameLight {
  vec3 ambient;
  uint mask;       // FLK_LIGHTS_TILES: the pixel's lights of the first 32
  uint tile;       // and where its masks lie
  vec3 direction, radiance;  // FLK_LIGHTS_SUN; its hair shadow map:
  int size;
  float texel, range;
};

FrameLight frameLight(uvec2 pixel) {
  FrameLight light = FrameLight(frame.ambient, 0u, 0u, vec3(0.0, 0.0, 1.0), vec3(0.0), 0, 0.0, 1.0);
  if (kLights == FLK_LIGHTS_SUN) {
    light.direction = LightList(frame.lights).at[0].place;
    light.radiance = LightList(frame.lights).at[0].radiance;
#ifdef FLK_BIND_SHADOW
    light.size = int(FaceList(frame.faces).at[0].size);
    light.texel = FaceList(frame.faces).at[0].texel;
    light.range = FaceList(frame.faces).at[0].range;
#endif
  }
  if (kLights == FLK_LIGHTS_TILES) {
    // The host's tiles cover the target; one that does not is not read past its end.
    uvec2 tile = min(pixel / frame.light_tile_size, uvec2(frame.light_tiles_x, frame.light_tiles_y) - 1u);
    light.tile = tile.y * frame.light_tiles_x + tile.x;
    light.mask = WordList(frame.light_tiles).at[light.tile];
  }
  return light;
}

// Positions of a pixel are a line in depth, in view space and in a sun's map.
struct PixelRay {
  vec3 origin, step;   // view space, of depth 0, a metre of depth
  vec3 to_eye;         // unit
  vec3 shadow_origin;  // texels and metre
  vec3 shadow_step;
};

PixelRay pixelRay(vec2 pixel) {
  vec3 at_one = unprojectPixel(pixel, 1.0, frame.proj_scale, frame.proj_offset, frame.orthographic, frame.size);
  bool orthographic = frame.orthographic > 0.5;
  PixelRay ray;
  ray.origin = orthographic ? vec3(at_one.xy, 0.0) : vec3(0.0);
  ray.step = at_one - ray.origin;
  ray.to_eye = orthographic ? vec3(0.0, 0.0, 1.0) : unitOrZero(-at_one);
#ifdef FLK_BIND_SHADOW
  if (kLights == FLK_LIGHTS_SUN) {
    mat4x3 map_from_view = FaceList(frame.faces).at[0].map_from_view;
    ray.shadow_origin = map_from_view * vec4(ray.origin, 1.0);
    ray.shadow_step = mat3(map_from_view) * ray.step;
  }
#endif
  return ray;
}

// docs/methods.md section 5, "Ambient".
vec3 ambientOn(vec3 tangent, vec3 constant) {
  if (!kAmbient) return constant;
  vec3 t = isDirection(tangent) ? tangent : vec3(0.0);
  return max(constant + t.x * t.x * frame.ambient_squares[0] + t.y * t.y * frame.ambient_squares[1] +
                 t.z * t.z * frame.ambient_squares[2] + t.x * t.y * frame.ambient_squares[3] +
                 t.x * t.z * frame.ambient_squares[4] + t.y * t.z * frame.ambient_squares[5], vec3(0.0));
}

#ifdef FLK_BIND_SHADOW
// The share of a light that hair lets through to a point of view space.
float hairShadow(HairConstants hair, LightConstants source, vec3 position, vec3 tangent, vec3 L, bool full) {
  if (kFaces == 0u || source.face_count == 0u) return 1.0;
  uint index = source.first_face;
  if ((kFaces & FLK_FACES_CUBE) != 0u && source.face_count > 1u) {
    float most = -1.0;
    for (uint i = 0u; i < source.face_count; ++i) {
      mat4x3 m = FaceList(frame.faces).at[source.first_face + i].map_from_view;
      float along = (m * vec4(position, 1.0)).z;
      if (along > most) most = along, index = source.first_face + i;
    }
  }
  FaceConstants face = FaceList(frame.faces).at[index];
  vec3 at = face.map_from_view * vec4(position, 1.0);
  float texel = face.texel;
  if ((kFaces & ~uint(FLK_FACES_ORTHOGRAPHIC)) != 0u && face.focal > 0.0) {
    if (!(at.z >= face.near)) return 1.0;  // also NaN; near > 0
    texel *= at.z;
    at = vec3(at.xy / at.z * face.focal, length(at));
  }
  if (kCountWork) shadow_taps += full ? kTaps : 1u;
  float bias = shadowBias(tangent, L, texel);
  return full ? shadowFull(shadow_map, ivec2(face.offset), at, int(face.size), bias, face.range, hair.fibres_per_metre, hair.shadow_log2, kTaps)
              : shadowLow(shadow_map, ivec2(face.offset), at, int(face.size), bias, face.range, hair.fibres_per_metre, hair.shadow_log2);
}
#endif

#ifdef FLK_BIND_HOST_LIGHT
float hostTap(LightConstants source, ivec2 texel, float z) {
  vec2 center = vec2(texel) + 0.5;
  if (any(lessThan(center, source.host_rect.xy)) || any(greaterThan(center, source.host_rect.zw))) return 1.0;
  ivec2 size = textureSize(host_shadow_maps, 0).xy;
  int layers = textureSize(host_shadow_maps, 0).z;
  if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, size)) || int(source.host_layer) >= layers) return 1.0;
  float held = texelFetch(host_shadow_maps, ivec3(texel, source.host_layer), 0).r;
  return source.host_sign * z <= source.host_sign * held + source.host_bias ? 1.0 : 0.0;
}

// The share of a light that the scene lets through: docs/methods.md section 4, "Host shadows".
float hostLight(LightConstants source, vec3 position, uvec2 pixel) {
  float lit = 1.0;
  if ((kHost & FLK_HOST_MAP) != 0u && source.host_layer != FLK_NO_LAYER) {
    vec4 p = source.host_from_view * vec4(position, 1.0);
    if (p.w > 0.0) {
      vec3 at = clamp(p.xyz / p.w, vec3(-1e6), vec3(1e6));  // must not wrap when it becomes an integer
      vec2 corner = floor(at.xy - 0.5), share = at.xy - 0.5 - corner;
      ivec2 texel = ivec2(corner);
      lit = mix(mix(hostTap(source, texel, at.z), hostTap(source, texel + ivec2(1, 0), at.z), share.x),
                mix(hostTap(source, texel + ivec2(0, 1), at.z), hostTap(source, texel + ivec2(1, 1), at.z), share.x), share.y);
    }
  }
  if ((kHost & FLK_HOST_VISIBILITY) != 0u && source.visibility_layer != FLK_NO_LAYER) {
    ivec3 size = textureSize(host_visibility, 0);
    if (all(lessThan(ivec3(pixel, source.visibility_layer), size)))
      lit *= clamp(texelFetch(host_visibility, ivec3(pixel, source.visibility_layer), 0).r, 0.0, 1.0);
  }
  return lit;
}
#endif

// Both qualities differ in the shadow's reads, and in what they make of the lobes.
vec3 shadeLight(HairConstants hair, vec3 fibre, vec3 tangent, vec3 L, vec3 to_eye, vec3 light, bool full) {
  return full || kLowShade == FLK_LOW_LOBES ? shadeFull(hair, fibre, tangent, L, to_eye, light)
                                                  : shadeLow(hair, fibre, tangent, L, light, kLowShade == FLK_LOW_MEAN_LOBES);
}

// One of many lights on a point of view space: docs/methods.md section 4.
vec3 radianceOfLight(uint index, HairConstants hair, vec3 fibre, vec3 tangent, vec3 position, vec3 to_eye, uvec2 pixel, bool full) {
  LightConstants source = LightList(frame.lights).at[index];
  vec3 L = source.place;
  float arriving = 1.0;
  if ((kLightKinds & ~1u) != 0u && source.kind != FLK_KIND_DIRECTIONAL) {
    vec3 way = source.place - position;
    float square = dot(way, way);
    L = unitOrZero(way);
    float share = square * source.inverse_range * source.inverse_range;
    float window = clamp(1.0 - share * share, 0.0, 1.0);
    arriving = window * window / max(square, source.source_radius_squared);
    if ((kLightKinds & 1u << FLK_KIND_SPOT) != 0u && source.kind == FLK_KIND_SPOT) {
      float cone = clamp((-dot(L, source.axis) - source.cos_outer) * source.inverse_cone, 0.0, 1.0);
      arriving *= cone * cone;
    }
  }
  if (!(arriving > 0.0)) return vec3(0.0);  // also NaN: infinitely far
#ifdef FLK_BIND_HOST_LIGHT
  arriving *= hostLight(source, position, pixel);
#endif
#ifdef FLK_BIND_SHADOW
  arriving *= hairShadow(hair, source, position, tangent, L, full);
#endif
  vec3 light = arriving * source.radiance;
  return shadeLight(hair, fibre, tangent, L, to_eye, light, full);
}

vec3 radianceOfLights(HairConstants hair, vec3 fibre, FrameLight source, vec3 tangent, PixelRay ray, float depth, uvec2 pixel, bool full) {
  vec3 position = ray.origin + depth * ray.step;
  vec3 sum = vec3(0.0);
  if (kLights == FLK_LIGHTS_ALL) {
    uint i = 0u;  // there is one at least
    do {
      sum += radianceOfLight(i, hair, fibre, tangent, position, ray.to_eye, pixel, full);
    } while (++i < frame.light_count);
  } else if (kLights == FLK_LIGHTS_TILES) {
    uint mask = source.mask, stride = frame.light_tiles_x * frame.light_tiles_y, first = 0u;
    do {
      do {
        uint i = first + uint(findLSB(mask));
        if (mask != 0u && i < frame.light_count) sum += radianceOfLight(i, hair, fibre, tangent, position, ray.to_eye, pixel, full);
        mask &= mask - 1u;
      } while (anyLane(mask != 0u));
      first += 32u;
      if (first < frame.light_count) mask = WordList(frame.light_tiles).at[first / 32u * stride + source.tile];
    } while (first < frame.light_count);
  }
  return sum;
}

// The share of a sun that hair lets through at a depth of the pixel.
float sunShadow(HairConstants hair, FrameLight source, vec3 tangent, PixelRay ray, float depth, bool full) {
#ifdef FLK_BIND_SHADOW
  if (kCountWork) shadow_taps += full ? kTaps : 1u;
  vec3 at = ray.shadow_origin + depth * ray.shadow_step;
  float bias = shadowBias(tangent, source.direction, source.texel);
  return full ? shadowFull(shadow_map, ivec2(0), at, source.size, bias, source.range, hair.fibres_per_metre, hair.shadow_log2, kTaps)
              : shadowLow(shadow_map, ivec2(0), at, source.size, bias, source.range, hair.fibres_per_metre, hair.shadow_log2);
#else
  return 1.0;
#endif
}

// fibre: its colour.
vec3 radianceFull(HairConstants hair, vec3 fibre, FrameLight source, vec3 tangent, PixelRay ray, float depth, uvec2 pixel) {
  if (kCountWork) full_shades += 1u;
  vec3 around = ambientOn(tangent, source.ambient) * hair.diffuse * fibre;
  if (kLights != FLK_LIGHTS_SUN) return around + radianceOfLights(hair, fibre, source, tangent, ray, depth, pixel, true);
  float light = sunShadow(hair, source, tangent, ray, depth, true);
  return around + shadeFull(hair, fibre, tangent, source.direction, ray.to_eye, light * source.radiance);
}

vec3 radianceLow(HairConstants hair, vec3 fibre, FrameLight source, vec3 tangent, PixelRay ray, float depth, uvec2 pixel) {
  if (kCountWork) low_shades += 1u;
  vec3 around = ambientOn(tangent, source.ambient) * hair.diffuse * fibre;
  if (kLights != FLK_LIGHTS_SUN) return around + radianceOfLights(hair, fibre, source, tangent, ray, depth, pixel, false);
  float light = sunShadow(hair, source, tangent, ray, depth, false);
  // The same as shadeLight(), with what all fragments of a hair share multiplied first.
  if (kLowShade == FLK_LOW_PLAIN) return around + light * diffuseShare(tangent, source.direction) * (source.radiance * hair.diffuse * fibre);
  return around + shadeLight(hair, fibre, tangent, source.direction, ray.to_eye, light * source.radiance, false);
}

#endif
