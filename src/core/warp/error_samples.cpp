// The points of a body at which a warp's error is measured, and what a pixel covers there.
// Based on: Lloyd et al., "Warping and Partitioning for Low Error Shadow Maps", 2006, as a Jacobian.
#include "warp/error_samples.hpp"
#include "gnomon/extend/body.hpp"
#include "gnomon/extend/warp.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>

#include "geometry/even_points.hpp"
#include "geometry/first_hits.hpp"
#include "geometry/vector.hpp"
#include "lanes/elementary.hpp"
#include "lanes/wide.hpp"

namespace gnomon {
namespace {

// Rays through the image for the even sampling, in whole lanes, and points along all of them together: of the
// first set, by which a search goes, and of those that compare what was found.
constexpr std::size_t kRays = HeldDepths::kRays;
static_assert(kRays % kDoubleLanes == 0);
constexpr std::size_t kSearched = 96, kCompared = PixelLanes::kMost;

/// A face of the body as a bound on 1 / depth along the ray (x, y, 1) of the image: linear in x and y, so
/// that finding where a ray is inside the body takes no division.
struct InverseDepthBound {
  double at, per_x, per_y;
};

/// The bounds of all faces: `least` from those that have the eye inside, `most` from those that have it
/// outside. Rays on the outer side of a face through the eye, where its `edge` is negative, miss the body.
struct InverseDepthBounds {
  std::array<InverseDepthBound, kMaxFaces> least, most, edge;
  std::size_t least_count = 0, most_count = 0, edge_count = 0;
};

struct ImageRange {
  double left, right, bottom, top;
};

/// Where the image shows the body at all.
ImageRange shown(const WarpInput& input) noexcept {
  const ViewInLight& view = input.view;
  ImageRange r{view.image_right, view.image_left, view.image_top, view.image_bottom};
  for (const Polytope::Vertex& v : input.polytope->vertices()) {
    const double inverse = 1.0 / max_of(glm::dot(view.forward, v.position), input.depth_begin);
    const double x = glm::dot(view.right, v.position) * inverse, y = glm::dot(view.up, v.position) * inverse;
    r = {min_of(r.left, x), max_of(r.right, x), min_of(r.bottom, y), max_of(r.top, y)};
  }
  return {max_of(r.left, view.image_left), min_of(r.right, view.image_right),
          max_of(r.bottom, view.image_bottom), min_of(r.top, view.image_top)};
}

/// Whether the face, which is through the eye, is an edge of the image or beyond: none of its rays miss.
bool holds(const InverseDepthBound& edge, const ImageRange& image) noexcept {
  constexpr double kRounding = 1e-9;
  for (const double x : {image.left, image.right}) {
    for (const double y : {image.bottom, image.top}) {
      const double size = std::abs(edge.at) + std::abs(edge.per_x * x) + std::abs(edge.per_y * y);
      if (edge.at + edge.per_x * x + edge.per_y * y < -kRounding * size) return false;
    }
  }
  return true;
}

InverseDepthBounds inverse_depth_bounds(const Polytope& body, const ViewInLight& view, double near_depth,
                                        const ImageRange& image) noexcept {
  InverseDepthBounds bounds;
  for (int f = 0; f < body.face_count; ++f) {
    const Plane& plane = body.plane[static_cast<std::size_t>(f)];
    const glm::dvec3 slopes{glm::dot(plane.normal, view.forward), glm::dot(plane.normal, view.right),
                            glm::dot(plane.normal, view.up)};
    // Faces nearer to the eye than rounding can tell pass through it.
    constexpr double kThroughEye = 1e-9;
    if (std::abs(plane.offset) <= kThroughEye * near_depth) {
      const InverseDepthBound edge{slopes.x, slopes.y, slopes.z};
      if (!holds(edge, image)) bounds.edge[bounds.edge_count++] = edge;
      continue;
    }
    const glm::dvec3 bound = slopes * (-1.0 / plane.offset);
    auto& side = plane.offset > 0.0 ? bounds.least : bounds.most;
    side[plane.offset > 0.0 ? bounds.least_count++ : bounds.most_count++] = {bound.x, bound.y, bound.z};
  }
  return bounds;
}

/// Rays through the image, 1 / depth where each is inside the body, and from that the depth where it enters
/// and the logarithm of the ratio to where it leaves.
struct Rays {
  alignas(64) std::array<double, kRays> x, y, least, most, begin, length;
};

GNOMON_WIDE void find_rays(const ImageRange& image, int set, const InverseDepthBounds& bounds, double most,
                           Rays& rays) noexcept {
  const double width = image.right - image.left, height = image.top - image.bottom;
  for (std::size_t i = 0; i < kRays; ++i) {
    // No table: a few operations take less room in a module of WebAssembly.
    const auto number = static_cast<double>(static_cast<int>(i) + set * static_cast<int>(kRays));
    rays.x[i] = image.left + width * spread(kEvenX, number);
    rays.y[i] = image.bottom + height * spread(kEvenY, number);
    rays.least[i] = 0.0;
    rays.most[i] = most;
  }
  for (std::size_t k = 0; k < bounds.least_count; ++k) {
    const InverseDepthBound b = bounds.least[k];
    for (std::size_t i = 0; i < kRays; ++i)
      rays.least[i] = max_of(rays.least[i], b.at + b.per_x * rays.x[i] + b.per_y * rays.y[i]);
  }
  for (std::size_t k = 0; k < bounds.most_count; ++k) {
    const InverseDepthBound b = bounds.most[k];
    for (std::size_t i = 0; i < kRays; ++i)
      rays.most[i] = min_of(rays.most[i], b.at + b.per_x * rays.x[i] + b.per_y * rays.y[i]);
  }
  for (std::size_t k = 0; k < bounds.edge_count; ++k) {
    const InverseDepthBound b = bounds.edge[k];
    for (std::size_t i = 0; i < kRays; ++i)
      rays.most[i] = b.at + b.per_x * rays.x[i] + b.per_y * rays.y[i] < 0.0 ? 0.0 : rays.most[i];
  }
  for (std::size_t i = 0; i < kRays; ++i) {
    const double least = rays.least[i], beyond = rays.most[i];
    const bool inside = least > 0.0 && least < beyond;
    constexpr double kNothing = 1e-150;
    // Of rays that miss, of which `beyond` may be below zero, nothing is read.
    const double far = divisor(std::abs(beyond), kNothing), ratio = far / divisor(least, kNothing);
    rays.begin[i] = 1.0 / far;
    rays.length[i] = lane::log(inside ? ratio : 1.0);
  }
}

/// Points on rays, from their place in the image, the depth where the ray begins, and the logarithm of what
/// is to be multiplied with it.
GNOMON_WIDE void find_points(const ViewInLight& view, std::size_t first, PixelLanes& lanes) noexcept {
  const double fx = view.forward.x, fy = view.forward.y, fz = view.forward.z;
  const double rx = view.right.x, ry = view.right.y, rz = view.right.z;
  const double ux = view.up.x, uy = view.up.y, uz = view.up.z;
  const std::size_t n = lanes.count;
  for (std::size_t i = first; i < n; ++i) {
    const double x = lanes.x[i], y = lanes.y[i], depth = lanes.z()[i] * lane::exp(lanes.size()[i]);
    lanes.x[i] = (fx + rx * x + ux * y) * depth;
    lanes.y[i] = (fy + ry * x + uy * y) * depth;
    lanes.z()[i] = (fz + rz * x + uz * y) * depth;
    lanes.size()[i] = 1.0;
  }
}

/// What is the same for all points. Steps are of one pixel at unit depth. Loops copy it: what they write
/// might be these numbers, for all that the compiler knows.
struct PixelTerms {
  glm::dvec3 forward, right, up;
  glm::dvec3 apex;
  double depth_begin;       // of what the depth is at least; orthographic: of both ends
  double depth_most;        // orthographic: 1
  double per_point, fixed;  // 1, 0 for rays from the eye; 0, 1 for parallel ones
  double least_area;
};

PixelTerms pixel_terms(const WarpInput& input) noexcept {
  const ViewInLight& view = input.view;
  // Of a pixel that rounding leaves no area, beside the eye or at the edge of a field of view near pi,
  // nothing is known.
  constexpr double kLeastArea = 1e-30;
  const bool flat = input.orthographic;
  return {view.forward,
          view.right * view.pixel_x,
          view.up * view.pixel_y,
          input.light.apex,
          flat ? 1.0 : input.depth_begin,
          flat ? 1.0 : std::numeric_limits<double>::max(),
          flat ? 0.0 : 1.0,
          flat ? 1.0 : 0.0,
          kLeastArea * view.pixel_x * view.pixel_y};
}

struct Vector {
  double x, y, z;
};
inline double dot(const Vector& a, const Vector& b) noexcept {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vector minus(const Vector& a, const Vector& b, double times) noexcept {
  return {a.x - b.x * times, a.y - b.y * times, a.z - b.z * times};
}

constexpr double kSmallest = 1e-280;
// Square of a sum of two rays below which it is their rounding: its direction says nothing.
constexpr double kOpposed = 1e-24;

/// The eye's ray to `p`, of unit length.
inline Vector eye_ray(const PixelTerms& t, const Vector& p) noexcept {
  const double per_length = t.per_point / std::sqrt(divisor(dot(p, p), kSmallest));
  return {p.x * per_length + t.forward.x * t.fixed, p.y * per_length + t.forward.y * t.fixed,
          p.z * per_length + t.forward.z * t.fixed};
}
/// The move in light space that a step across the image makes on a surface that faces the half vector: the
/// mirror of it as in pixel_footprint.hpp; where it vanishes, so does its effect.
inline Vector mirrored(const Vector& step, const Vector& eye, const Vector& sum, double twice) noexcept {
  const Vector across = minus(step, eye, dot(eye, step));
  return minus(across, sum, twice * dot(sum, across));
}
/// Twice the inverse of the squared length of a sum of rays; 0 where they oppose each other: less than twice
/// would flatten the pixel.
inline double mirror_factor(double sum_squared) noexcept {
  const double twice = 2.0 / divisor(sum_squared, kOpposed);
  return sum_squared > kOpposed ? twice : 0.0;
}
inline double extent(const PixelTerms& t, const Vector& p, double size) noexcept {
  const double depth = t.forward.x * p.x + t.forward.y * p.y + t.forward.z * p.z;
  return min_of(max_of(depth, t.depth_begin), t.depth_most) * size;
}
/// 0 where nothing is known of the pixel.
inline double inverse_area(double determinant, double least) noexcept {
  const bool known = std::abs(determinant) > least;
  const double inverse = inverse_or_0(determinant);
  return known ? inverse : 0.0;
}

GNOMON_WIDE void find_parallel(const PixelTerms& terms, PixelLanes& l) noexcept {
  const PixelTerms t = terms;
  const Vector right{t.right.x, t.right.y, t.right.z}, up{t.up.x, t.up.y, t.up.z};
  const std::size_t n = whole_lanes(l.count);
  for (std::size_t i = 0; i < n; ++i) {
    const Vector p{l.x[i], l.y[i], l.z()[i]};
    const Vector eye = eye_ray(t, p), sum{eye.x, eye.y, eye.z - 1.0};
    const double twice = mirror_factor(dot(sum, sum)), scale = extent(t, p, l.size()[i]);
    const Vector a = mirrored(right, eye, sum, twice), b = mirrored(up, eye, sum, twice);
    const double xx = a.x * scale, yx = a.y * scale, xy = b.x * scale, yy = b.y * scale;
    l.xx[i] = xx;
    l.xy[i] = xy;
    l.yx[i] = yx;
    l.yy[i] = yy;
    l.inverse_determinant[i] = inverse_area(xx * yy - xy * yx, t.least_area * scale * scale);
  }
}

GNOMON_WIDE void find_local(const PixelTerms& terms, PixelLanes& l) noexcept {
  const PixelTerms t = terms;
  const Vector right{t.right.x, t.right.y, t.right.z}, up{t.up.x, t.up.y, t.up.z};
  const std::size_t n = whole_lanes(l.count);
  for (std::size_t i = 0; i < n; ++i) {
    const Vector p{l.x[i], l.y[i], l.z()[i]};
    const Vector from{p.x - t.apex.x, p.y - t.apex.y, p.z - t.apex.z};
    const double largest = max_of(max_of(std::abs(from.x), std::abs(from.y)), std::abs(from.z));
    const double inverse = 1.0 / divisor(largest, kSmallest);
    const Vector scaled{from.x * inverse, from.y * inverse, from.z * inverse};
    const double per_length = 1.0 / std::sqrt(divisor(dot(scaled, scaled), kSmallest));
    const Vector eye = eye_ray(t, p);
    const Vector sum{eye.x + scaled.x * per_length, eye.y + scaled.y * per_length,
                     eye.z + scaled.z * per_length};
    const double twice = mirror_factor(dot(sum, sum)), scale = extent(t, p, l.size()[i]);
    const Vector a = mirrored(right, eye, sum, twice), b = mirrored(up, eye, sum, twice);
    const double distance = -from.z, h = inverse_or_0(distance), x = from.x * h, y = from.y * h,
                 unit = scale * h;
    const double xx = (a.x + x * a.z) * unit, yx = (a.y + y * a.z) * unit;
    const double xy = (b.x + x * b.z) * unit, yy = (b.y + y * b.z) * unit;
    const double known = inverse_area(xx * yy - xy * yx, t.least_area * unit * unit);
    l.x[i] = x;
    l.y[i] = y;
    l.xx[i] = xx;
    l.xy[i] = xy;
    l.yx[i] = yx;
    l.yy[i] = yy;
    l.inverse_determinant[i] = distance > 0.0 ? known : 0.0;
  }
}

}  // namespace

void PixelLanes::fill_lanes() noexcept {
  for (std::size_t i = count; count > 0 && i < whole_lanes(count); ++i) {
    for (auto* lane : {&x, &y, &xx, &xy, &yx, &yy, &inverse_determinant}) (*lane)[i] = (*lane)[0];
  }
}

void add_vertices(const Polytope& body, double size, PixelLanes& lanes) noexcept {
  for (const Polytope::Vertex& v : body.vertices()) lanes.add(v.position, size);
}

void add_middles(const Polytope& body, double size, PixelLanes& lanes) noexcept {
  for (std::size_t i = 0; i < body.vertices().size(); ++i) {
    const Polytope::Vertex& v = body.vertex[i];
    for (const std::uint8_t other : v.neighbour) {
      if (other > i) lanes.add((v.position + body.vertex[other].position) * 0.5, size);
    }
  }
}

void add_faces(const Polytope& body, double size, PixelLanes& lanes) noexcept {
  std::array<glm::dvec3, kMaxFaces> sum{};
  std::array<int, kMaxFaces> corners{};
  for (const Polytope::Vertex& v : body.vertices()) {
    for (const std::uint8_t f : v.face) {
      sum[f] += v.position;
      ++corners[f];
    }
  }
  for (std::size_t f = 0; f < sum.size(); ++f) {
    if (corners[f] > 0) lanes.add(sum[f] / static_cast<double>(corners[f]), size);
  }
}

namespace {

/// Evenly spaced in the total length of all rays: each point stands for an equal share of what is seen.
void spread_points(const Rays& rays, std::size_t count, PixelLanes& lanes) noexcept {
  double total = 0.0;
  for (const double length : rays.length) total += length;
  if (!(total > 0.0 && total < std::numeric_limits<double>::infinity())) return;
  const double spacing = total / static_cast<double>(count);
  double next = 0.5 * spacing;
  for (std::size_t i = 0; i < kRays; ++i) {
    const double length = rays.length[i];
    for (; next < length; next += spacing) lanes.add({rays.x[i], rays.y[i], rays.begin[i]}, next);
    next -= length;
  }
}

/// Evenly chosen ones of the depths that boxes hold, or the nearest and the farthest of each ray.
void choose_held(const HeldDepths& held, const Rays& rays, int set, std::size_t count,
                 PixelLanes& lanes) noexcept {
  constexpr double kLn2 = 0.6931471805599453;
  std::array<std::uint64_t, kRays> cells;
  int total = 0;
  for (std::size_t i = 0; i < kRays; ++i) {
    cells[i] = 0;
    if (!(rays.length[i] > 0.0)) continue;
    cells[i] = held.cells[i] & held.between(i, rays.begin[i], 1.0 / rays.least[i]).bits();
    total += std::popcount(cells[i]);
  }
  const auto add = [&](std::size_t ray, int cell) {
    lanes.add({rays.x[ray], rays.y[ray], 1.0},
              (held.first + held.step * (cell + HeldDepths::into_cell(ray))) * kLn2);
  };
  if (set == kRayEnds) {
    for (std::size_t i = 0; i < kRays; ++i) {
      if (cells[i] == 0) continue;
      add(i, std::countr_zero(cells[i]));
      add(i, HeldDepths::kCells - 1 - std::countl_zero(cells[i]));
    }
    return;
  }
  const double stride = max_of(1.0, total / static_cast<double>(count));
  double next = stride * (set + 0.5) / kRaySets;
  int at = 0;
  for (std::size_t i = 0; i < kRays; ++i) {
    for (; cells[i] != 0; cells[i] &= cells[i] - 1, ++at) {
      if (at < next) continue;
      next += stride;
      add(i, std::countr_zero(cells[i]));
    }
  }
}

/// `held`: where boxes are; nullptr: anywhere in the body.
void add_visible_points(const WarpInput& input, const HeldDepths* held, int set, PixelLanes& lanes) noexcept {
  const ViewInLight& view = input.view;
  const ImageRange whole{view.image_left, view.image_right, view.image_bottom, view.image_top};
  const ImageRange image = held != nullptr ? whole : shown(input);
  const InverseDepthBounds bounds = inverse_depth_bounds(*input.polytope, view, input.depth_begin, image);
  Rays rays;
  find_rays(image, held != nullptr ? 0 : set, bounds, 1.0 / input.depth_begin, rays);
  const std::size_t first = lanes.count, count = set == 0 ? kSearched : kCompared;
  if (held != nullptr) {
    choose_held(*held, rays, set, count, lanes);
  } else {
    spread_points(rays, count, lanes);
  }
  find_points(view, first, lanes);
  const Polytope* const focus = input.focus;
  if (focus == nullptr || focus->empty()) return;
  for (std::size_t i = first; i < lanes.count; ++i) {
    for (int f = 0; f < focus->face_count; ++f) {
      const Plane& plane = focus->plane[static_cast<std::size_t>(f)];
      if (glm::dot(plane.normal, {lanes.x[i], lanes.y[i], lanes.z()[i]}) + plane.offset < 0.0)
        lanes.size()[i] = input.focus_weight;
    }
  }
}

}  // namespace

void add_visible_points(const WarpInput& input, int set, PixelLanes& lanes) noexcept {
  // A body that few of the image's rays meet has points of its own.
  constexpr std::size_t kFew = 40;
  const std::size_t first = lanes.count;
  if (input.held != nullptr) add_visible_points(input, input.held, set, lanes);
  if (lanes.count >= first + kFew) return;
  lanes.count = first;
  if (set != kRayEnds) add_visible_points(input, nullptr, set, lanes);
}

void add_seen_points(const WarpInput& input, PixelLanes& lanes) noexcept {
  const Polytope* const focus = input.focus;
  for (const glm::dvec3& p : input.seen) {
    double times = 1.0;
    for (int f = 0; focus != nullptr && !focus->empty() && f < focus->face_count; ++f) {
      const Plane& plane = focus->plane[static_cast<std::size_t>(f)];
      if (glm::dot(plane.normal, p) + plane.offset < 0.0) times = input.focus_weight;
    }
    lanes.add(p, times);
  }
}

std::size_t find_pixels(const WarpInput& input, PixelLanes& lanes) noexcept {
  lanes.fill_lanes();
  const PixelTerms terms = pixel_terms(input);
  if (input.light.perspective) {
    find_local(terms, lanes);
  } else {
    find_parallel(terms, lanes);
  }
  std::size_t known = 0;
  while (known < lanes.count && lanes.inverse_determinant[known] != 0.0) ++known;
  std::size_t kept = known;
  for (std::size_t i = known; i < lanes.count; ++i) {
    // No number is unknown, too.
    if (!(std::abs(lanes.inverse_determinant[i]) > 0.0)) continue;
    for (auto* lane :
         {&lanes.x, &lanes.y, &lanes.xx, &lanes.xy, &lanes.yx, &lanes.yy, &lanes.inverse_determinant})
      (*lane)[kept] = (*lane)[i];
    ++kept;
  }
  lanes.count = kept;
  lanes.fill_lanes();
  return known;
}

}  // namespace gnomon
