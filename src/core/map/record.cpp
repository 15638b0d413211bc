// Everything of a map's record that follows from its plane, its matrix and its swept body.
#include "map/record.hpp"

#include <cmath>
#include <glm/geometric.hpp>

#include "geometry/vector.hpp"
#include "map/size.hpp"

namespace gnomon {
namespace {

void write_planes(const PlanContext& c, const SweptBody& swept, ShadowMap& map) noexcept {
  for (int i = 0; i < swept.plane_count; ++i) {
    const Plane& p = swept.plane[static_cast<std::size_t>(i)];
    map.cull_planes[static_cast<std::size_t>(i)] =
        glm::dvec4(p.normal, p.offset - glm::dot(p.normal, c.camera.position));
  }
  // Equal plans have equal records.
  for (std::size_t i = static_cast<std::size_t>(swept.plane_count); i < map.cull_planes.size(); ++i)
    map.cull_planes[i] = glm::dvec4(0.0);
  map.cull_plane_count = swept.plane_count;
}

/// Extents of texels: at the body's centre, and where they are largest, which is at one of its vertices.
void write_texels(const PlanContext& c, const MapRequest& request, const MapParts& parts,
                  ShadowMap& map) noexcept {
  const LightSpace& space = request.space;
  const auto texel_at = [&](const glm::dvec3& p) {
    const glm::dvec3 way = space.ray(space.frame.turned(p));
    const glm::dvec3 world = space.frame.x * way.x + space.frame.y * way.y + space.frame.z * way.z;
    return texel_extent_world(parts.gl_from_relative, map.texels(),
                              space.perspective ? safe_normalize(world, -space.frame.z) : -space.frame.z, p);
  };
  glm::dvec3 centre(0.0);
  for (const Polytope::Vertex& v : request.body.vertices()) centre += v.position;
  centre /= static_cast<double>(request.body.vertex_count);
  map.texel_world = map.texel_world_max = texel_at(centre);
  const auto grow = [&](const glm::dvec2& texel) {
    map.texel_world_max = {max_of(map.texel_world_max.x, texel.x), max_of(map.texel_world_max.y, texel.y)};
  };
  if (!space.perspective) {
    if (parts.plane.choice.kappa != 0.0)
      grow(parts.needed.in_light_plane /
           (glm::dvec2(map.width, map.height) - 2.0 * map.filter_margin_texels));
  } else {
    for (const Polytope::Vertex& v : request.body.vertices()) {
      // Nearer than the map's nearest distance is only rounding.
      if (space.distance(space.frame.turned(v.position)) < parts.body.nearest) continue;
      grow(texel_at(v.position));
    }
  }
  const double texel = max_of(map.texel_world.x, map.texel_world.y);
  const BiasOptions& bias = c.options.bias;
  map.bias_world = {bias.constant_texels * texel, bias.slope_texels * texel,
                    bias.normal_offset_texels * texel};
}

}  // namespace

glm::dmat4 world_matrix(const glm::dmat4& from_relative, const glm::dvec3& eye_world) noexcept {
  glm::dmat4 m = from_relative;
  m[3] = from_relative * glm::dvec4(-eye_world, 1.0);
  return m;
}

void begin_record(const PlanContext& c, const MapRequest& request, ShadowMap& map) noexcept {
  const MapSlot& slot = request.slot;
  map.cascade = slot.cascade;
  map.width = slot.width;
  map.height = slot.height;
  map.depth_begin = slot.depth_begin;
  map.depth_end = slot.depth_end;
  map.overlap = slot.overlap;
  map.warp = &request.warp;
  map.select_plane_count = slot.select_count;
  for (int i = 0; i < slot.select_count; ++i) {
    const Plane& plane = slot.select[static_cast<std::size_t>(i)];
    map.select_planes[static_cast<std::size_t>(i)] =
        glm::dvec4(plane.normal, plane.offset - glm::dot(plane.normal, c.camera.position));
  }
}

void complete_record(const PlanContext& c, const MapRequest& request, const MapParts& parts,
                     ShadowMap& map) noexcept {
  write_planes(c, parts.swept, map);
  map.kappa = parts.plane.choice.kappa;
  const LightSpace& space = request.space;
  const glm::dmat4 from_relative = clip_from_gl_clip(c.options.clip_space) * parts.gl_from_relative;
  map.clip_from_camera_relative = glm::mat4(from_relative);
  map.clip_from_world = world_matrix(from_relative, c.camera.position);
  const glm::dvec3 apex =
      space.frame.x * space.apex.x + space.frame.y * space.apex.y + space.frame.z * space.apex.z;
  map.light_world =
      space.perspective ? glm::dvec4(apex + c.camera.position, 1.0) : glm::dvec4(space.frame.z, 0.0);
  write_texels(c, request, parts, map);
  const glm::dvec2 inside = glm::dvec2(map.width, map.height) - 2.0 * map.filter_margin_texels;
  map.m_s_max = parts.needed.sides.x / inside.x;
  map.m_t_max = parts.needed.sides.y / inside.y;
  map.m_max = parts.needed.bound(inside, parts.obliquity);
  map.storage = map.m_s_max * map.m_t_max * static_cast<double>(map.width) * map.height /
                (static_cast<double>(c.camera.width) * c.camera.height);
}

}  // namespace gnomon
