// GLSL's names for C++, so that one header lays out a structure for both. Scalar layout: no padding but what is written.
#ifndef FORELOCK_SHARED_TYPES_H
#define FORELOCK_SHARED_TYPES_H
#ifdef __cplusplus
#include <cstdint>
namespace forelock::gpu {
using uint = std::uint32_t;
struct vec2 { float x, y; };
struct uvec2 { uint x, y; };
struct vec3 { float x, y, z; };
struct vec4 { float x, y, z, w; };
struct uvec4 { uint x, y, z, w; };
struct mat4x3 { float m[12]; };  // 4 columns of 3 rows
struct mat4 { float m[16]; };
}  // namespace forelock::gpu
#endif
#endif
