// Skin and other opaque surfaces: diffuse with a faint gloss, in the shadow of hair and of each other. SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "opaque_push.glsl"
#include "opaque_shadow.glsl"

layout(location = 0) in vec3 in_position;
layout(location = 1) in vec3 in_normal;
layout(location = 2) in float in_openness;
layout(location = 0) out vec4 out_color;

// What arrives at p of a light of colour 1, and from where: docs/methods.md section 4.
float arriving(LightConstants light, vec3 p, out vec3 to_light) {
  if (light.placed == 0) {
    to_light = light.to_light;
    return 1.0;
  }
  vec3 d = light.position - p;
  float square = dot(d, d);
  to_light = d * inversesqrt(max(square, 1e-12));
  float reach = square * light.inverse_range * light.inverse_range;
  float window = max(1.0 - reach * reach, 0.0);
  float cone = light.cone_scale > 0.0 ? clamp((dot(to_light, light.to_light) - light.cos_outer) * light.cone_scale, 0.0, 1.0) : 1.0;
  return window * window * cone * cone / max(square, light.least_square);
}

// Irradiance / pi from nine coefficients of radiance: Ramamoorthi and Hanrahan 2001, their A_l / pi being 1, 2/3, 1/4.
vec3 irradiance(vec3 n) {
  Frame frame = push.frame;
  vec3 sum = 0.282095 * frame.at.ambient_sh[0] +
             (2.0 / 3.0) * 0.488603 * (n.y * frame.at.ambient_sh[1] + n.z * frame.at.ambient_sh[2] + n.x * frame.at.ambient_sh[3]) +
             0.25 * (1.092548 * (n.x * n.y * frame.at.ambient_sh[4] + n.y * n.z * frame.at.ambient_sh[5] + n.x * n.z * frame.at.ambient_sh[7]) +
                     0.315392 * (3.0 * n.z * n.z - 1.0) * frame.at.ambient_sh[6] +
                     0.546274 * (n.x * n.x - n.y * n.y) * frame.at.ambient_sh[8]);
  return max(sum, vec3(0.0));
}

void main() {
  Frame frame = push.frame;
  vec3 p = in_position;
  // Zero where a mesh's normals cancel out.
  vec3 normal = in_normal * inversesqrt(max(dot(in_normal, in_normal), 1e-12)) * (gl_FrontFacing ? 1.0 : -1.0);
  vec3 to_eye = frame.at.orthographic != 0 ? frame.at.back : normalize(frame.at.eye - p);
  vec3 diffuse = vec3(0.0), gloss = vec3(0.0);
  float weight = 0.0, weighted_through = 0.0, all = 0.0;
  for (uint i = 0; i < frame.at.light_count; ++i) {
    LightConstants light = push.lights.at[i];
    vec3 to_light;
    float lit = arriving(light, p, to_light);
    float facing = dot(normal, to_light);
    float strength = light.color.x + light.color.y + light.color.z;
    all += lit * strength;
    lit *= max(facing, 0.0);
    if (lit <= 0.0) {
      continue;
    }
    if (light.layer >= 0) {
      lit *= pastMeshes(light, frame.at.push, p, normal, facing);
    }
    if (light.face_count > 0 && lit > 0.0) {
      float through = pastHair(light, p, -frame.at.fibres_per_metre * frame.at.log2_transmittance);
      float share = lit * strength;
      weight += share;
      weighted_through += share * through;
      lit *= through;
    }
    float cosine = max(dot(normal, normalize(to_light + to_eye)), 0.0);
    float square = cosine * cosine;
    diffuse += light.color * (lit * 0.3183099);
    gloss += light.color * (0.05 * lit * square * square * square * square * 0.3183099);
  }
  float through = weight > 0.0 ? weighted_through / weight : 1.0;
  // What hides the light hides much of the sky. Where little of the light would arrive anyway it tells nothing: no edge at the terminator.
  float sky_through = 1.0 - 0.6 * (1.0 - through) * clamp(4.0 * weight / max(all, 1e-12), 0.0, 1.0);
  vec3 sky = frame.at.ambient * (0.6 + 0.4 * normal.y) + irradiance(normal);
  vec3 albedo = vec3(push.albedo_red, push.albedo_green, push.albedo_blue);
  out_color = vec4(albedo * (diffuse + sky * (in_openness * sky_through)) + gloss, 1.0);
}
