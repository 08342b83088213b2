// rounds > 0: independent chains of multiply-adds, eight a lane, so that neither latency nor memory counts. rounds 0: a copy, because
// a copy command may be done by an engine that is slower than the shaders are (a fifth on an NVIDIA H200).
#version 460

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) buffer Result { vec4 result[]; };
layout(set = 0, binding = 1) readonly buffer Source { vec4 source[]; };
layout(push_constant) uniform Push { uint rounds, count; };

void main() {
  if (rounds == 0u) {
    for (uint i = gl_GlobalInvocationID.x; i < count; i += gl_NumWorkGroups.x * 64u) result[i] = source[i];
    return;
  }
  const float start = float(gl_GlobalInvocationID.x & 1023u) * 1e-3;
  vec4 a = vec4(start, start + 0.1, start + 0.2, start + 0.3), b = a + 0.5;
  // Not fma(): where a processor has none, its one rounding takes hundreds of instructions.
  for (uint i = 0; i < rounds; ++i) {
    // 64 of a lane; the fixed point 1 is approached, so that values stay ordinary numbers.
    a = a * vec4(0.5) + vec4(0.5), b = b * vec4(0.75) + vec4(0.25);
    a = a * vec4(0.5) + vec4(0.5), b = b * vec4(0.75) + vec4(0.25);
    a = a * vec4(0.5) + vec4(0.5), b = b * vec4(0.75) + vec4(0.25);
    a = a * vec4(0.5) + vec4(0.5), b = b * vec4(0.75) + vec4(0.25);
    a = a * vec4(0.5) + vec4(0.5), b = b * vec4(0.75) + vec4(0.25);
    a = a * vec4(0.5) + vec4(0.5), b = b * vec4(0.75) + vec4(0.25);
    a = a * vec4(0.5) + vec4(0.5), b = b * vec4(0.75) + vec4(0.25);
    a = a * vec4(0.5) + vec4(0.5), b = b * vec4(0.75) + vec4(0.25);
  }
  const float sum = dot(a, vec4(1)) + dot(b, vec4(1));
  if (sum < -1e30) result[0] = vec4(sum);  // never, but no compiler knows
}
