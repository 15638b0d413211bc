// Several cameras that share a plan's maps: the union of what they see, and each point with its own view
// depth.
#include "map/shared_views.hpp"
#include "gnomon/extend/body.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "geometry/body.hpp"
#include "geometry/vector.hpp"
#include "geometry/visible.hpp"
#include "map/size.hpp"

namespace gnomon {
namespace {

constexpr int kCorners = 8;  // of a part of a frustum

void translate(Polytope& body, const glm::dvec3& by) noexcept {
  for (int i = 0; i < body.vertex_count; ++i) body.vertex[static_cast<std::size_t>(i)].position += by;
  for (int f = 0; f < body.face_count; ++f) {
    Plane& plane = body.plane[static_cast<std::size_t>(f)];
    plane.offset -= glm::dot(plane.normal, by);
  }
}

/// Corners of the smallest part of the view's frustum that holds `body`: fewer points than a body may have.
void add_corners(const SharedView& view, const Polytope& body, ViewedPoints& out) noexcept {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  glm::dvec3 low(kInfinity), high(-kInfinity);
  for (const Polytope::Vertex& v : body.vertices()) {
    const glm::dvec3 p = v.position - view.eye;
    const double depth = max_of(view.depth(v.position), view.camera.near_depth);
    const double scale = view.camera.orthographic ? 1.0 : 1.0 / depth;
    const glm::dvec3 at{glm::dot(view.axes.right, p) * scale, glm::dot(view.axes.up, p) * scale, depth};
    low = glm::min(low, at);
    high = glm::max(high, at);
  }
  for (int corner = 0; corner < kCorners; ++corner) {
    const double depth = (corner & 4) != 0 ? high.z : low.z;
    const double scale = view.camera.orthographic ? 1.0 : depth;
    const glm::dvec3 position = view.eye + view.axes.forward * depth +
                                view.axes.right * (((corner & 1) != 0 ? high.x : low.x) * scale) +
                                view.axes.up * (((corner & 2) != 0 ? high.y : low.y) * scale);
    out.point[static_cast<std::size_t>(out.count++)] = {position, depth};
  }
}

/// `part` by view; those that see nothing are empty. The error counts from the depth `counted_from` on. Where
/// that cuts a part, its own points are infinitely deep, and those of what is left are added.
void add_points(std::span<const SharedView> views, std::span<const Polytope> part, double counted_from,
                ViewedPoints& out) noexcept {
  std::array<Polytope, kMaxViews> counted;
  int vertices = 0;
  for (std::size_t i = 0; i < part.size(); ++i) {
    const glm::dvec3& forward = views[i].axes.forward;
    if (!views[i].camera.orthographic)
      counted[i] = part_inside(part[i], Plane{forward, -counted_from - glm::dot(forward, views[i].eye)});
    vertices += part[i].vertex_count + counted[i].vertex_count;
  }
  const auto add = [&](const glm::dvec3& position, double depth) {
    out.point[static_cast<std::size_t>(out.count++)] = {position, depth};
  };
  constexpr double kNever = std::numeric_limits<double>::infinity();
  Box uncounted;
  for (std::size_t i = 0; i < part.size(); ++i) {
    if (part[i].empty()) continue;
    const bool cut = !counted[i].empty();
    if (vertices > kMaxBodyPoints) {
      add_corners(views[i], cut ? counted[i] : part[i], out);
      if (cut) uncounted.extend(bounds_of(part[i]));
      continue;
    }
    for (const Polytope::Vertex& v : part[i].vertices())
      add(v.position, cut ? kNever : views[i].depth(v.position));
    for (const Polytope::Vertex& v : counted[i].vertices()) add(v.position, views[i].depth(v.position));
  }
  if (uncounted.empty()) return;
  for (int corner = 0; corner < kCorners; ++corner)
    add({(corner & 1) != 0 ? uncounted.max.x : uncounted.min.x,
         (corner & 2) != 0 ? uncounted.max.y : uncounted.min.y,
         (corner & 4) != 0 ? uncounted.max.z : uncounted.min.z},
        kNever);
}
static_assert(kMaxBodyPoints >= (kMaxViews + 1) * kCorners);

struct Interval {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
  void extend(double v) noexcept {
    low = min_of(low, v);
    high = max_of(high, v);
  }
};

}  // namespace

Polytope view_slice(const SharedView& view, double begin, double end) noexcept {
  Polytope slice = frustum_slice(view.camera, view.axes, begin, end);
  translate(slice, view.eye);
  return slice;
}

DepthRange receiver_depths(std::span<const SharedView> views) noexcept {
  Interval depths;
  for (const SharedView& view : views) {
    for (const Polytope::Vertex& v : view.body.vertices()) depths.extend(view.depth(v.position));
  }
  return {depths.low, depths.high};
}

Polytope receivers_between(const SharedView& view, double begin, double end) noexcept {
  Polytope part = view.body;
  const double at_eye = glm::dot(view.axes.forward, view.eye);
  clip_to_slab(part, view.axes.forward, begin + at_eye, end + at_eye);
  return part;
}

Polytope hull_of(std::span<const Polytope> parts) noexcept {
  Box box;
  for (const Polytope& part : parts) box.extend(bounds_of(part));
  Polytope hull;
  if (box.empty()) return hull;
  hull = box_polytope(box);
  for (const Polytope& part : parts) {
    if (part.empty()) continue;
    for (int f = 0; f < part.face_count; ++f) {
      Plane plane = part.plane[static_cast<std::size_t>(f)];
      plane.offset = -std::numeric_limits<double>::infinity();
      for (const Polytope& other : parts) {
        for (const Polytope::Vertex& v : other.vertices())
          plane.offset = max_of(plane.offset, -glm::dot(plane.normal, v.position));
      }
      clip(hull, plane);
    }
  }
  return hull;
}

Polytope view_body(const PlanContext& c) noexcept {
  if (c.views.empty()) return frustum_slice(c.camera, c.axes, c.camera.near_depth, c.camera.far_depth);
  std::array<Polytope, kMaxViews> part;
  for (std::size_t i = 0; i < c.views.size(); ++i) part[i] = c.views[i].body;
  return hull_of({part.data(), c.views.size()});
}

ViewedPoints viewed_between(const PlanContext& c, double begin, double end, double counted_from,
                            Polytope& hull) noexcept {
  std::array<Polytope, kMaxViews> part;
  const std::span<Polytope> parts{part.data(), c.views.size()};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    parts[i] = receivers_between(c.views[i], begin, end);
    clip_part(parts[i], c.bounds.receivers, c.camera.position);
  }
  hull = hull_of(parts);
  ViewedPoints viewed;
  add_points(c.views, parts, counted_from, viewed);
  return viewed;
}

ViewedPoints viewed_within(const PlanContext& c, const Polytope& body) noexcept {
  std::array<Polytope, kMaxViews> part;
  const std::span<Polytope> parts{part.data(), c.views.size()};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    parts[i] = c.views[i].body;
    for (int f = 0; f < body.face_count; ++f) clip(parts[i], body.plane[static_cast<std::size_t>(f)]);
  }
  ViewedPoints viewed;
  add_points(c.views, parts, c.options.split.pseudo_near, viewed);
  return viewed;
}

Camera mean_camera(std::span<const SharedView> views, const glm::dvec3& origin) noexcept {
  // Views that look apart have no mean way: the first stands in.
  constexpr double kApart = 0.1;
  // Steeper rays than this lie beside the image, or behind it.
  constexpr double kSteepest = 20.0;
  Camera mean = views[0].camera;
  mean.position = origin;
  glm::dvec3 forward(0.0);
  for (const SharedView& view : views) forward += view.axes.forward;
  if (largest_component(forward) > kApart * static_cast<double>(views.size())) mean.forward = forward;
  const CameraAxes axes = camera_axes(mean);
  Interval x, y;
  double finest = 0.0;
  for (const SharedView& view : views) {
    const Camera& camera = view.camera;
    mean.near_depth = min_of(mean.near_depth, camera.near_depth);
    mean.far_depth = max_of(mean.far_depth, camera.far_depth);
    finest = max_of(finest, pixels_per_slope(camera));
    for (int corner = 0; corner < 4; ++corner) {
      const glm::dvec3 across = view.axes.right * ((corner & 1) != 0 ? camera.right : camera.left) +
                                view.axes.up * ((corner & 2) != 0 ? camera.top : camera.bottom);
      const glm::dvec3 ray = camera.orthographic ? across + view.eye : across + view.axes.forward;
      const double along = camera.orthographic ? 1.0 : glm::dot(axes.forward, ray);
      const double at_x = glm::dot(axes.right, ray), at_y = glm::dot(axes.up, ray);
      const double least = camera.orthographic ? 1.0 : max_of(std::abs(at_x), std::abs(at_y)) / kSteepest;
      const double depth = max_of(along, least);
      if (!(depth > 0.0)) continue;  // straight behind
      x.extend(at_x / depth);
      y.extend(at_y / depth);
    }
  }
  // Where all rays of all views are as steep on one side, there is no image between them: the first stands
  // in.
  if (!(x.high > x.low && y.high > y.low)) {
    mean.forward = views[0].camera.forward;
    return mean;
  }
  mean.left = x.low;
  mean.right = x.high;
  mean.bottom = y.low;
  mean.top = y.high;
  // The image of equal cameras is as many pixels wide as theirs.
  constexpr double kMaxPixels = 1 << 20, kRounding = 1e-6;
  // Without a branch, before which a compiler might convert what no int holds.
  const auto pixels = [&](const Interval& side) {
    const double count = std::ceil(finest * (side.high - side.low) - kRounding);
    return static_cast<int>(min_of(max_of(count, 1.0), kMaxPixels));
  };
  mean.width = pixels(x);
  mean.height = pixels(y);
  return mean;
}

}  // namespace gnomon
