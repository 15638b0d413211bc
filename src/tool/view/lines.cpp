// The camera, the maps and the boxes of a plan as lines in the picture of another camera.
#include "lines.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "gnomon/extend/body.hpp"
#include "gnomon/motion.hpp"
#include "gnomon/render/picture.hpp"
#include "page_pictures.hpp"

namespace gnomon::tool::view {
namespace {

/// Cuts the segment of clip coordinates where dot(plane, p) < 0; false where nothing is left.
bool cut(glm::dvec4& a, glm::dvec4& b, const glm::dvec4& plane) {
  const double da = glm::dot(plane, a), db = glm::dot(plane, b);
  if (da < 0.0 && db < 0.0) return false;
  if (da < 0.0) a += (b - a) * (da / (da - db));
  if (db < 0.0) b += (a - b) * (db / (db - da));
  return true;
}

void add_polytope(const Polytope& body, const glm::dvec3& origin, const glm::u8vec4& color,
                  std::vector<WorldLine>& lines) {
  for (int i = 0; i < body.vertex_count; ++i) {
    const Polytope::Vertex& vertex = body.vertex[static_cast<std::size_t>(i)];
    for (const std::uint8_t other : vertex.neighbour) {
      if (other > i)
        lines.push_back({origin + vertex.position, origin + body.vertex[other].position, color, 2.0});
    }
  }
}

/// Corner by its number: bit 0 is x, bit 1 is y, bit 2 is z.
template <class Corner>
void add_cuboid(Corner&& corner, const glm::u8vec4& color, double width, std::vector<WorldLine>& lines) {
  for (int i = 0; i < 8; ++i) {
    for (int bit = 1; bit < 8; bit <<= 1)
      if ((i & bit) == 0) lines.push_back({corner(i), corner(i | bit), color, width});
  }
}

void add_box(const Box& box, const glm::u8vec4& color, std::vector<WorldLine>& lines) {
  if (box.empty()) return;
  add_cuboid(
      [&box](int i) {
        return glm::dvec3((i & 1) != 0 ? box.max.x : box.min.x, (i & 2) != 0 ? box.max.y : box.min.y,
                          (i & 4) != 0 ? box.max.z : box.min.z);
      },
      color, 1.0, lines);
}

glm::dvec3 world_at(const glm::dmat4& world_from_clip, double x, double y, double z) {
  const glm::dvec4 p = world_from_clip * glm::dvec4(x, y, z, 1.0);
  return glm::dvec3(p) / p.w;
}

/// Outline of a page at the far end of its volume.
void add_page(const ClipSpace& clip_space, const ShadowMap& page, const glm::u8vec4& color,
              std::vector<WorldLine>& lines) {
  const glm::dmat4 world_from_clip = glm::inverse(page.clip_from_world);
  const bool one = clip_space.ndc_depth == NdcDepth::zero_to_one;
  const double farthest = !clip_space.reversed_z ? 1.0 : one ? 0.0 : -1.0;
  const auto corner = [&](int i) {
    return world_at(world_from_clip, i == 1 || i == 2 ? 1.0 : -1.0, i >= 2 ? 1.0 : -1.0, farthest);
  };
  for (int i = 0; i < 4; ++i) lines.push_back({corner(i), corner((i + 1) % 4), color, 1.5});
}

void add_map_volume(const ClipSpace& clip_space, const ShadowMap& map, const glm::u8vec4& color,
                    std::vector<WorldLine>& lines) {
  const glm::dmat4 world_from_clip = glm::inverse(map.clip_from_world);
  const double nearest = clip_space.ndc_depth == NdcDepth::zero_to_one ? 0.0 : -1.0;
  add_cuboid(
      [&](int i) {
        return world_at(world_from_clip, (i & 1) != 0 ? 1.0 : -1.0, (i & 2) != 0 ? 1.0 : -1.0,
                        (i & 4) != 0 ? 1.0 : nearest);
      },
      color, 1.5, lines);
}

/// Every box once: in the colour of the first map that draws it, or grey where none does.
void add_casters(std::span<const ShadowMap> maps, const std::vector<glm::u8vec4>& colors,
                 const std::vector<Box>& boxes, std::vector<WorldLine>& lines) {
  constexpr glm::u8vec4 kCulled{150, 150, 150, 70};
  constexpr std::size_t kNone = ~std::size_t{0};
  std::vector<std::size_t> drawn(boxes.size(), kNone);
  std::vector<std::uint32_t> list(boxes.size());
  for (std::size_t i = maps.size(); i-- > 0;) {
    const std::size_t count = cull_casters(maps[i], boxes, list);
    for (std::size_t n = 0; n < std::min(count, list.size()); ++n) drawn[list[n]] = i;
  }
  for (std::size_t n = 0; n < boxes.size(); ++n)
    add_box(boxes[n], drawn[n] == kNone ? kCulled : colors[drawn[n]], lines);
}

void add_frustum(const Camera& frozen, std::vector<WorldLine>& lines) {
  constexpr glm::u8vec4 kFrustum{255, 255, 255, 255};
  add_polytope(frustum_slice(frozen, camera_axes(frozen), frozen.near_depth, frozen.far_depth),
               frozen.position, kFrustum, lines);
}

}  // namespace

std::vector<ScreenLine> on_screen(const std::vector<WorldLine>& lines, const Camera& camera) {
  const glm::dmat4 clip_from_world = clip_from_view(camera) * view_from_world(camera);
  std::vector<ScreenLine> result;
  result.reserve(lines.size());
  for (const WorldLine& line : lines) {
    glm::dvec4 a = clip_from_world * glm::dvec4(line.from, 1.0),
               b = clip_from_world * glm::dvec4(line.to, 1.0);
    // The near plane, and the image with some room for the line's width.
    constexpr double kRoom = 1.1;
    if (!cut(a, b, {0, 0, 1, 1}) || !cut(a, b, {1, 0, 0, kRoom}) || !cut(a, b, {-1, 0, 0, kRoom}) ||
        !cut(a, b, {0, 1, 0, kRoom}) || !cut(a, b, {0, -1, 0, kRoom}) || !(a.w > 0.0) || !(b.w > 0.0))
      continue;
    const auto pixel = [&camera](const glm::dvec4& p) {
      return glm::dvec2((p.x / p.w + 1.0) * 0.5 * camera.width, (1.0 - p.y / p.w) * 0.5 * camera.height);
    };
    result.push_back({pixel(a), pixel(b), line.color, line.width});
  }
  return result;
}

std::vector<WorldLine> body_lines(const ShadowMap& map, const Camera& camera, const Box& scene,
                                  const glm::u8vec4& color) {
  std::vector<WorldLine> lines;
  const double begin = std::max(map.depth_begin, camera.near_depth),
               end = std::min(map.depth_end, camera.far_depth);
  if (!(begin < end) || scene.empty()) return lines;
  Polytope body = frustum_slice(camera, camera_axes(camera), begin, end);
  clip(body, Box{scene.min - camera.position, scene.max - camera.position});
  add_polytope(body, camera.position, color, lines);
  return lines;
}

std::vector<WorldLine> culling_lines(const ShadowMap& map, const Box& scene, const glm::u8vec4& color) {
  std::vector<WorldLine> lines;
  if (scene.empty()) return lines;
  Polytope within = box_polytope(scene);
  for (int i = 0; i < map.cull_plane_count; ++i) {
    const glm::dvec4& plane = map.cull_planes[static_cast<std::size_t>(i)];
    clip(within, Plane{glm::dvec3(plane), plane.w});
  }
  add_polytope(within, glm::dvec3(0.0), color, lines);
  return lines;
}

std::vector<WorldLine> plan_lines(const ShadowPlan& plan, const Camera& frozen, const std::vector<Box>& boxes,
                                  const Box& scene, const Drawn& drawn) {
  std::vector<WorldLine> lines;
  std::vector<glm::u8vec4> colors;
  for (std::size_t i = 0; i < plan.maps().size(); ++i)
    colors.emplace_back(render::cascade_color(static_cast<int>(i)), 255);
  if (drawn.casters) add_casters(plan.maps(), colors, boxes, lines);
  for (std::size_t i = 0; i < plan.maps().size(); ++i) {
    const glm::u8vec4 color = colors[i];
    if (drawn.maps) add_map_volume(plan.clip_space, plan.map[i], color, lines);
    if (drawn.culling) {
      const std::vector<WorldLine> within = culling_lines(plan.map[i], scene, color);
      lines.insert(lines.end(), within.begin(), within.end());
    }
    if (!drawn.bodies) continue;
    const std::vector<WorldLine> body = body_lines(plan.map[i], frozen, scene, color);
    lines.insert(lines.end(), body.begin(), body.end());
  }
  if (drawn.frustum) add_frustum(frozen, lines);
  return lines;
}

std::vector<WorldLine> page_lines(const PagePlan& plan, const Camera& frozen, const std::vector<Box>& boxes,
                                  const Drawn& drawn) {
  std::vector<WorldLine> lines;
  std::vector<ShadowMap> maps;
  std::vector<glm::u8vec4> colors;
  for (const Page& page : plan.pages) {
    maps.push_back(page_map(plan, page));
    colors.emplace_back(level_color(page.level, plan.levels.size()), 255);
  }
  if (drawn.casters) add_casters(maps, colors, boxes, lines);
  for (std::size_t i = 0; drawn.maps && i < maps.size(); ++i)
    add_page(plan.clip_space, maps[i], colors[i], lines);
  if (drawn.frustum) add_frustum(frozen, lines);
  return lines;
}

ShadowPlan from_frozen(ShadowPlan plan, const Camera& frozen, const Camera& camera) noexcept {
  const glm::dvec3 forward = camera_axes(frozen).forward;
  const double at_eye = glm::dot(forward, frozen.position);
  constexpr double kEverywhere = 1e30;  // world units, and still a number in single precision
  plan.origin_world = camera.position;
  for (std::size_t i = 0; i < plan.maps().size(); ++i) {
    ShadowMap& map = plan.map[i];
    map = rebased(map, camera.position);
    // Depths of the frozen view as planes of the world: those of the new one mean nothing to the plan.
    if (plan.selection == MapSelection::view_depth && map.select_plane_count + 2 <= kMaxSelectPlanes) {
      auto& planes = map.select_planes;
      planes[static_cast<std::size_t>(map.select_plane_count++)] =
          glm::dvec4(forward, -at_eye - map.depth_begin);
      planes[static_cast<std::size_t>(map.select_plane_count++)] =
          glm::dvec4(-forward, at_eye + map.depth_end);
    }
    map.depth_begin = -kEverywhere;
    map.depth_end = kEverywhere;
    map.overlap = 0.0;
  }
  if (plan.selection == MapSelection::view_depth) plan.selection = MapSelection::first_holding;
  return plan;
}

}  // namespace gnomon::tool::view
