// A plan as shaders read it: one block of numbers, the same under std140 and std430.
#pragma once

#include <array>
#include <cstddef>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <string_view>

#include "gnomon/plan.hpp"

namespace gnomon {

/// One shadow map: ShadowMap of shaders/library/shadow_map.glsl.
struct ShaderMap {
  /// Clip space for look-ups, from points relative to ShadowPlan::origin_world. x and y are -1..1 over the
  /// rows of the texture as they lie in memory, z is 0 near the light .. 1. The plan's clip space is taken
  /// into account.
  glm::mat4 clip_from_point;
  glm::vec4 interval_size;  ///< view depths served (begin, end), width and height in texels
  std::array<glm::vec4, kMaxSelectPlanes> select_planes;  ///< relative to the origin; (0, 0, 0, 1): unused
  glm::mat4 shape;                                        ///< shader_shape()
  glm::vec4 kernel;  ///< filter margin in texels, half blur in texels, width of the blend band, depth curve
};

/// Everything that shaders/library needs of a plan: ShadowBlock of shaders/library/shadow_block.glsl. Copy it
/// into a uniform buffer (std140) or a storage buffer (std430) as it is.
struct ShaderBlock {
  glm::vec4 light;  ///< direction of parallel light with w = 0, or position relative to the origin with w = 1
  glm::vec4 bias;   ///< BiasOptions: constant, slope, normal offset, largest slope
  /// Width and height of the texture's layers in texels; number of maps; shader_selection().
  glm::vec4 layer;
  std::array<ShaderMap, kMaxMaps> maps;  ///< in the order of ShadowPlan::maps; those beyond are zero
};

/// A field of ShaderBlock and where it starts, bytes; fields of the maps are those of the first map.
struct ShaderField {
  std::string_view name;  ///< as in the GLSL
  std::size_t offset;     ///< bytes from the start of the block
};

/// The layout that the GLSL is checked against.
inline constexpr std::array<ShaderField, 8> kShaderFields{{
    {"light", offsetof(ShaderBlock, light)},
    {"bias", offsetof(ShaderBlock, bias)},
    {"layer", offsetof(ShaderBlock, layer)},
    {"maps.clip_from_point", offsetof(ShaderBlock, maps) + offsetof(ShaderMap, clip_from_point)},
    {"maps.interval_size", offsetof(ShaderBlock, maps) + offsetof(ShaderMap, interval_size)},
    {"maps.select_planes", offsetof(ShaderBlock, maps) + offsetof(ShaderMap, select_planes)},
    {"maps.shape", offsetof(ShaderBlock, maps) + offsetof(ShaderMap, shape)},
    {"maps.kernel", offsetof(ShaderBlock, maps) + offsetof(ShaderMap, kernel)},
}};

/// The texture that the maps were drawn into, one map a layer.
struct ShaderLayers {
  int width = 0;             ///< texels of a layer; 0: those of the largest map
  int height = 0;            ///< the same
  double blur_texels = 0.0;  ///< half side of the box that stored texels were blurred with; 0: not blurred
};

/// A map's shape as shaders read it. Its place in shapes.def, then its parameters in the clip space that they
/// look the map up in, column by column.
[[nodiscard]] glm::mat4 shader_shape(const ShadowMap& map, const glm::dmat4& lookup_from_map) noexcept;
/// ShadowPlan::selection as `layer.w` of ShaderBlock has it: 0 view_depth, 1 first_holding, 2 finest.
[[nodiscard]] float shader_selection(const ShadowPlan& plan) noexcept;
/// Fills the block for the plan's clip space. The shader defines GNOMON_REVERSED_Z where that has
/// reversed_z. A plan without maps gives a block with none.
[[nodiscard]] ShaderBlock shader_block(const ShadowPlan& plan, const ShaderLayers& layers = {}) noexcept;

}  // namespace gnomon
