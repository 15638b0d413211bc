// Brings a plan into the numbers that the shader library reads, whatever clip space it was made for.
#include "gnomon/extend/shape.hpp"
#include "gnomon/shader.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace gnomon {
namespace {

static_assert(sizeof(ShaderMap) == 160 + 16 * kMaxSelectPlanes && sizeof(ShaderBlock) % 16 == 0,
              "matrices and vectors of four have no padding under std140 and std430");

/// The plan's clip space to the one for look-ups: -1..1 along the texture's columns and rows, z 0 near the
/// light.
glm::dmat4 lookup_from_clip(const ClipSpace& space) noexcept {
  glm::dmat4 centred(1.0);
  centred[0][0] = centred[1][1] = 2.0;
  centred[3][0] = centred[3][1] = -1.0;
  if (space.reversed_z) {
    centred[2][2] = -1.0;
    centred[3][2] = 1.0;
  }
  return centred * texture_from_clip(space);
}

/// Far over near distance less 1 along the middle ray of a local light: makes depths even in distance. 0 for
/// parallel light.
double depth_curve(const ShadowMap& map, const glm::dmat4& lookup_from_map) noexcept {
  if (map.light_world.w == 0.0) return 0.0;
  const glm::dmat4 world_from_lookup = glm::inverse(lookup_from_map * map.clip_from_world);
  const auto distance = [&](double z) {
    const glm::dvec4 h = world_from_lookup * glm::dvec4(0.0, 0.0, z, 1.0);
    return glm::length(glm::dvec3(h) / h.w - glm::dvec3(map.light_world));
  };
  const double curve = distance(1.0) / distance(0.0) - 1.0;
  return std::isfinite(curve) ? std::max(curve, 0.0) : 0.0;
}

ShaderMap shader_map(const ShadowMap& map, const glm::dmat4& lookup_from_map, const glm::dvec3& origin,
                     double blur) noexcept {
  ShaderMap out{};
  out.clip_from_point = glm::mat4(lookup_from_map * glm::dmat4(map.clip_from_camera_relative));
  out.interval_size = glm::vec4(glm::dvec4(map.depth_begin, map.depth_end, map.width, map.height));
  out.select_planes.fill({0.0f, 0.0f, 0.0f, 1.0f});
  for (int i = 0; i < map.select_plane_count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const glm::dvec4 plane = map.select_planes[at];
    out.select_planes[at] =
        glm::vec4(glm::vec3(plane), static_cast<float>(plane.w + glm::dot(glm::dvec3(plane), origin)));
  }
  out.shape = shader_shape(map, lookup_from_map);
  out.kernel =
      glm::vec4(glm::dvec4(map.filter_margin_texels, blur, map.overlap, depth_curve(map, lookup_from_map)));
  return out;
}

}  // namespace

glm::mat4 shader_shape(const ShadowMap& map, const glm::dmat4& lookup_from_map) noexcept {
  const std::span<const Shape* const> all = all_shapes();
  const auto place = std::find(all.begin(), all.end(), map.shape) - all.begin();
  const ShapeParameters p = parameters_in(lookup_from_map, *map.shape, map.shape_parameters);
  glm::mat4 shape(static_cast<float>(place));
  for (int i = 0; i < static_cast<int>(p.size()); ++i)
    shape[(i + 1) / 4][(i + 1) % 4] = static_cast<float>(p[static_cast<std::size_t>(i)]);
  return shape;
}

// As map_serving of shaders/library/select_map.glsl takes it.
float shader_selection(const ShadowPlan& plan) noexcept {
  return static_cast<float>(plan.selection);
}

ShaderBlock shader_block(const ShadowPlan& plan, const ShaderLayers& layers) noexcept {
  ShaderBlock block{};
  int width = layers.width, height = layers.height;
  for (const ShadowMap& map : plan.maps()) {
    if (layers.width <= 0) width = std::max(width, map.width);
    if (layers.height <= 0) height = std::max(height, map.height);
  }
  block.light = glm::vec4(glm::vec3(plan.light_direction), 0.0f);
  if (plan.map_count > 0 && plan.map[0].light_world.w != 0.0) {
    block.light = glm::vec4(glm::vec3(glm::dvec3(plan.map[0].light_world) - plan.origin_world), 1.0f);
  }
  block.bias = glm::vec4(glm::dvec4(plan.bias.constant_texels, plan.bias.slope_texels,
                                    plan.bias.normal_offset_texels, plan.bias.max_slope));
  block.layer = glm::vec4(width, height, plan.map_count, shader_selection(plan));
  const glm::dmat4 lookup_from_map = lookup_from_clip(plan.clip_space);
  for (std::size_t i = 0; i < plan.maps().size(); ++i) {
    block.maps[i] = shader_map(plan.map[i], lookup_from_map, plan.origin_world, layers.blur_texels);
  }
  return block;
}

}  // namespace gnomon
