// Makes GLSL's type names available to C++, so that every layout in shaders/shared is written once.
// A quad is one uvec4 (16 bytes): floats are stored by their bits, integers as they are.
#ifndef IRRADIA_SHARED_TYPES_H
#define IRRADIA_SHARED_TYPES_H

#ifdef __cplusplus
#include <cstdint>
#include <glm/glm.hpp>
namespace irradia::gpu {
using uint = uint32_t;
using glm::ivec2;
using glm::ivec4;
using glm::uvec2;
using glm::uvec3;
using glm::uvec4;
using glm::vec2;
using glm::vec3;
using glm::vec4;
} // namespace irradia::gpu
#define SHARED_BEGIN namespace irradia::gpu {
#define SHARED_END }
#define SHARED_CONST inline constexpr
#define SHARED_FUNCTION constexpr
#define SHARED_INLINE inline
#else
#define SHARED_BEGIN
#define SHARED_END
#define SHARED_CONST const
#define SHARED_FUNCTION
#define SHARED_INLINE
#endif

#endif
