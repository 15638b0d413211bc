// Random cameras, lights and boxes for the laws, and points that such a camera sees.
#include "random_case.hpp"
#include "gnomon/extend/body.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <ostream>

#include "property.hpp"

namespace gnomon::test {
namespace {

Camera draw_camera(const CaseLimits& limits) {
  const int kind = pick(6);
  const double far_depth = std::exp2(between(-2.0, 9.0));
  const glm::dvec3 position = glm::dvec3(between(-2, 2), between(-2, 2), between(-2, 2)) * far_depth;
  const double yaw = between(0.0, 2.0 * std::numbers::pi), pitch = between(-1.5, 1.5);
  const glm::dvec3 forward{std::sin(yaw) * std::cos(pitch), std::sin(pitch),
                           -std::cos(yaw) * std::cos(pitch)};
  const double near_depth = far_depth / std::pow(limits.max_depth_ratio, between(0.02, 1.0));
  const double aspect = between(0.4, 2.5);
  const int height = 64 + pick(1017);
  const int width = std::max(1, static_cast<int>(height * aspect));
  if (kind == 0 && limits.orthographic) {
    return orthographic_camera(position, forward, {0, 1, 0}, far_depth * between(0.02, 2.0), aspect,
                               near_depth, far_depth, width, height);
  }
  const double fov = between(1.0, 150.0) * std::numbers::pi / 180.0;
  Camera camera =
      perspective_camera(position, forward, {0, 1, 0}, fov, aspect, near_depth, far_depth, width, height);
  if (kind == 1 && limits.off_axis) {
    const double shift_x = between(-1.5, 1.5) * camera.right, shift_y = between(-1.5, 1.5) * camera.top;
    camera.left += shift_x;
    camera.right += shift_x;
    camera.bottom += shift_y;
    camera.top += shift_y;
  }
  return camera;
}

glm::dvec3 draw_light(const Camera& camera, const CaseLimits& limits) {
  const glm::dvec3 forward = camera_axes(camera).forward;
  const int kind = pick(8);
  const double sign = chance(0.5) ? -1.0 : 1.0;
  const glm::dvec3 anywhere{between(-1, 1), between(-1, 1), between(-1, 1)};
  const bool zero = glm::dot(anywhere, anywhere) < 1e-3;
  const glm::dvec3 free = zero ? glm::dvec3(0.1, -1.0, 0.2) : glm::normalize(anywhere);
  if (kind == 0) return {0.0, -1.0, 0.0};
  if (kind == 1 && limits.light_along_view) return forward * sign;
  if (kind == 2 && limits.light_along_view)
    return forward * sign + free * std::pow(10.0, between(-12.0, -1.0));
  if (kind == 3) return glm::normalize(glm::cross(forward, free));
  if (!limits.light_along_view && glm::length(glm::cross(forward, free)) < 0.05) return any_across(forward);
  return free * std::pow(10.0, between(-3.0, 3.0));
}

Box random_box(const Camera& camera, Random& random) {
  const double reach = std::max(camera.near_depth, camera.far_depth * 1e-6);
  const double depth = reach * std::pow(1.2 * camera.far_depth / reach, random.unit());
  const glm::dvec3 centre = point_at(camera, random.between(-1.3, 1.3), random.between(-1.3, 1.3), depth);
  const double scale = camera.orthographic ? camera.far_depth : depth;
  glm::dvec3 half;
  for (int axis = 0; axis < 3; ++axis) {
    half[axis] = random.unit() < 0.1 ? 0.0 : scale * std::pow(10.0, random.between(-2.5, 0.3));
  }
  if (random.unit() < 0.02) half = glm::dvec3(0.0);
  return {centre - half, centre + half};
}

}  // namespace

glm::dvec3 Random::direction() {
  for (;;) {
    const glm::dvec3 v{between(-1, 1), between(-1, 1), between(-1, 1)};
    const double length = glm::length(v);
    if (length > 0.1 && length < 1.0) return v / length;
  }
}

ShadowPlan Case::plan() const {
  return make_plan({camera, visible}, DirectionalLight{light}, bounds(), options);
}

std::ostream& operator<<(std::ostream& out, const Case& c) {
  const auto vector = [&](const char* name, const glm::dvec3& v) {
    out << name << " (" << v.x << ", " << v.y << ", " << v.z << ") ";
  };
  out.precision(17);
  vector("eye", c.camera.position);
  vector("forward", c.camera.forward);
  out << (c.camera.orthographic ? "orthographic " : "perspective ") << c.camera.left << ' ' << c.camera.right
      << ' ' << c.camera.bottom << ' ' << c.camera.top << " depths " << c.camera.near_depth << ' '
      << c.camera.far_depth << " pixels " << c.camera.width << ' ' << c.camera.height << ' ';
  vector("light", c.light);
  out << c.casters.size() << " casters " << c.receivers.size() << " receivers, fit "
      << to_string(c.options.fit) << " cascades " << c.options.cascades << " map "
      << c.options.resolution.max_size << " filter " << c.options.filter.texels << " split "
      << to_string(c.options.split.scheme) << " hint " << c.options.split.pseudo_near << " warp "
      << (c.options.warp.warp ? c.options.warp.warp->name : "auto") << '\n';
  for (const Box& box : c.receivers) {
    vector("  receiver", box.min);
    vector("..", box.max);
    out << '\n';
  }
  return out;
}

glm::dvec3 any_across(const glm::dvec3& v) {
  const glm::dvec3 other = std::abs(v.x) < 0.5 * glm::length(v) ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  return glm::normalize(glm::cross(v, other));
}

Case draw_case(const CaseLimits& limits) {
  Case c;
  c.camera = draw_camera(limits);
  c.light = draw_light(c.camera, limits);
  c.options.cascades = 1 + pick(8);
  c.options.resolution.max_size = 64 << pick(6);
  c.options.split.scheme = static_cast<SplitScheme>(pick(5));
  c.options.split.lambda = unit();
  if (chance(0.3))
    c.options.split.pseudo_near =
        c.camera.near_depth * std::pow(c.camera.far_depth / c.camera.near_depth, unit());
  const double fit = unit();
  c.options.fit = fit > 0.6   ? Fit::stable
                  : fit < 0.1 ? Fit::rotated
                  : fit < 0.2 ? Fit::warped_stable
                              : Fit::tight;
  c.options.split.range = static_cast<SplitRange>(pick(3));
  c.options.warp.objective = static_cast<Objective>(pick(3));
  const int warp = pick(static_cast<int>(all_warps().size()) + 1);
  c.options.warp.warp = warp == 0 ? nullptr : all_warps()[static_cast<std::size_t>(warp - 1)];
  c.options.filter.texels = chance(0.5) ? between(0.0, 8.0) : 0.0;

  const int receivers = 1 + pick(limits.max_boxes), casters = 1 + pick(limits.max_boxes);
  Random random(static_cast<std::uint64_t>(pick(1 << 30)));
  for (int i = 0; i < receivers; ++i) c.receivers.push_back(random_box(c.camera, random));
  if (chance(0.3)) {  // a ground under everything
    const glm::dvec3 e = c.camera.position;
    const double f = c.camera.far_depth;
    c.receivers.push_back(
        {{e.x - 2 * f, e.y - 0.2 * f, e.z - 2 * f}, {e.x + 2 * f, e.y - 0.1 * f, e.z + 2 * f}});
  }
  if (chance(0.3)) {
    c.casters = c.receivers;
    return c;
  }
  const glm::dvec3 towards_light = -glm::normalize(c.light);
  for (int i = 0; i < casters; ++i) {
    Box box = random_box(c.camera, random);
    if (random.unit() < 0.6) {  // over a receiver, often outside of the view
      const Box& below =
          c.receivers[static_cast<std::size_t>(random.pick(static_cast<int>(c.receivers.size())))];
      const glm::dvec3 shift = 0.5 * (below.min + below.max) - 0.5 * (box.min + box.max) +
                               towards_light * (c.camera.far_depth * random.between(0.0, 3.0));
      box = {box.min + shift, box.max + shift};
    }
    c.casters.push_back(box);
  }
  return c;
}

glm::dvec3 point_at(const Camera& camera, double x, double y, double depth) {
  const CameraAxes axes = camera_axes(camera);
  const double scale = camera.orthographic ? 1.0 : depth;
  const double image_x = camera.left + (camera.right - camera.left) * (0.5 + 0.5 * x);
  const double image_y = camera.bottom + (camera.top - camera.bottom) * (0.5 + 0.5 * y);
  return camera.position + axes.right * (image_x * scale) + axes.up * (image_y * scale) +
         axes.forward * depth;
}

double depth_of(const Camera& camera, const glm::dvec3& point) {
  return glm::dot(camera_axes(camera).forward, point - camera.position);
}

std::vector<glm::dvec3> visible_points(const Case& c, Random& random, int boxes, int per_box) {
  std::vector<glm::dvec3> points;
  const Polytope frustum =
      frustum_slice(c.camera, camera_axes(c.camera), c.camera.near_depth, c.camera.far_depth);
  for (int i = 0; i < boxes; ++i) {
    const Box& box = c.receivers[static_cast<std::size_t>(random.pick(static_cast<int>(c.receivers.size())))];
    Polytope part = frustum;
    clip(part, Box{box.min - c.camera.position, box.max - c.camera.position});
    if (part.empty()) continue;
    for (int k = 0; k < per_box; ++k) {
      // A mix of one to four vertices: corners, edges, faces and inside.
      glm::dvec3 sum(0.0);
      double total = 0.0;
      const int mixed = 1 + random.pick(4);
      for (int m = 0; m < mixed; ++m) {
        const double weight = random.between(0.01, 1.0);
        sum += part.vertex[static_cast<std::size_t>(random.pick(part.vertex_count))].position * weight;
        total += weight;
      }
      points.push_back(c.camera.position + sum / total);
    }
  }
  return points;
}

const ShadowMap* map_for(const ShadowPlan& plan, double depth) {
  for (const ShadowMap& map : plan.maps()) {
    if (depth >= map.depth_begin && depth <= map.depth_end) return &map;
  }
  return nullptr;
}

Crossing cross(const Box& box, const glm::dvec3& start, const glm::dvec3& step) {
  double enter = 0.0, leave = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    if (step[axis] == 0.0) {
      if (start[axis] < box.min[axis] || start[axis] > box.max[axis]) return {false, 0.0, 0.0};
      continue;
    }
    const double a = (box.min[axis] - start[axis]) / step[axis];
    const double b = (box.max[axis] - start[axis]) / step[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return {enter <= leave, enter, leave};
}

}  // namespace gnomon::test
