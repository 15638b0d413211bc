// Which answer must a look-up give, whatever its texels' centres and its bias are? Triangles in the space of
// a map, by arithmetic alone. Based on: Sutherland, Hodgman, "Reentrant Polygon Clipping", 1974.
#include "decided.hpp"

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "base/travel.hpp"
#include "gnomon/extend/shape.hpp"
#include "gnomon/study/bias.hpp"

namespace gnomon::stress {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
// Rasterizers snap corners to 1/256 texel, and edges move by as much on either side.
constexpr double kSnapTexels = 1.0 / 128.0;
// Roundings of a float that a number goes through on its way to a comparison: a product of a matrix, and the
// division by w, in two programs; interpolation in between.
constexpr double kRoundings = 8.0, kFloatStep = 0x1p-24;
// A light that is closer to grazing than this leaves no bias that is of any use.
constexpr double kLeastCosine = 0.05;

double largest(const glm::dvec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

}  // namespace

std::vector<WorldTriangle> world_triangles(const Scene& scene, const glm::dvec3& eye) {
  std::vector<WorldTriangle> all;
  for (const bool masked : {false, true}) {
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
      const Instance& instance = scene.instances[i];
      const Primitive& primitive = scene.primitives[instance.primitive];
      const Material& material = scene.materials[static_cast<std::size_t>(primitive.material)];
      if ((material.alpha_mode != AlphaMode::opaque) != masked) continue;
      for (std::uint32_t k = 0; k + 2 < primitive.index_count; k += 3) {
        WorldTriangle& t = all.emplace_back();
        for (std::uint32_t c = 0; c < 3; ++c) {
          const std::uint32_t vertex = scene.indices[primitive.first_index + k + c];
          t.corner[c] =
              glm::dvec3(instance.world_from_object * glm::dvec4(scene.positions[vertex], 1.0)) - eye;
        }
        t.instance = i;
        t.masked = masked;
        t.casts = instance.casts;
        const glm::dvec3 u = t.corner[1] - t.corner[0], v = t.corner[2] - t.corner[0];
        t.flat = !(glm::length(glm::cross(u, v)) > 1e-12 * glm::length(u) * glm::length(v));
      }
    }
  }
  return all;
}

/// What one look-up needs of the map at its point.
struct MapSpace::Look {
  Rectangle texels, ndc;
  double w = 1.0;
  glm::dvec3 ndc_point{0.0};
  double snap = 0.0;  ///< that edges and centres may be off by, texels
  double cosine = 1.0, sine = 0.0;
  glm::dvec2 texel_world{0.0};
  glm::dvec3 travel{0.0};
};

MapSpace::MapSpace(const ShadowMap& map, const ClipSpace& clip_space, const glm::dvec3& eye_world,
                   const Light& light, const std::vector<WorldTriangle>& triangles)
    : map_(map),
      triangles_(triangles),
      light_(light),
      eye_(eye_world),
      clip_from_relative_(map.clip_from_world * glm::translate(glm::dmat4(1.0), eye_world)),
      depth_unit_(clip_space.ndc_depth == NdcDepth::zero_to_one ? 1.0 : 2.0) {
  for (const WorldTriangle& t : triangles) {
    Shape3& shape = shapes_.emplace_back();
    shape.low = glm::dvec2(kInfinite);
    shape.high = glm::dvec2(-kInfinite);
    bool before = true;
    for (std::size_t c = 0; c < 3; ++c) {
      shape.clip[c] = clip_from_relative_ * glm::dvec4(t.corner[c], 1.0);
      extent_ = glm::max(extent_, glm::abs(t.corner[c]));
      before = before && shape.clip[c].w > 0.0;
      const glm::dvec2 ndc = glm::dvec2(shape.clip[c]) / shape.clip[c].w;
      shape.low = glm::min(shape.low, ndc);
      shape.high = glm::max(shape.high, ndc);
    }
    if (!before) {
      shape.low = glm::dvec2(-kInfinite);
      shape.high = glm::dvec2(kInfinite);
    }
  }
}

double MapSpace::row_terms(int row) const {
  return std::abs(clip_from_relative_[0][row]) * extent_.x +
         std::abs(clip_from_relative_[1][row]) * extent_.y +
         std::abs(clip_from_relative_[2][row]) * extent_.z + std::abs(clip_from_relative_[3][row]);
}

bool MapSpace::look_at(const Receiver3& r, double reach_texels, Look& look) const {
  const glm::dvec4 clip = clip_from_relative_ * glm::dvec4(r.point, 1.0);
  if (!(clip.w > 0.0)) return false;
  look.w = clip.w;
  look.ndc_point = glm::dvec3(clip) / clip.w;
  look.travel = travel_at(light_, r.point + eye_);
  look.cosine = -glm::dot(r.normal, look.travel);
  if (!(look.cosine > kLeastCosine)) return false;
  look.sine = std::sqrt(std::max(1.0 - look.cosine * look.cosine, 0.0));
  const TexelGrid grid = map_.texels();
  const ShapedPoint place = grid.place(glm::dvec2(look.ndc_point));
  look.texel_world = texel_extent_world(map_.clip_from_world, grid, look.travel, r.point + eye_);
  // What a float's matrix and products leave of the place, in ndc.
  glm::dvec2 error;
  for (int axis = 0; axis < 2; ++axis)
    error[axis] =
        kRoundings * kFloatStep * (row_terms(axis) + std::abs(look.ndc_point[axis]) * row_terms(3)) / clip.w;
  const double off =
      std::max(std::abs(place.texel_from_ndc[0].x) * error.x + std::abs(place.texel_from_ndc[1].x) * error.y,
               std::abs(place.texel_from_ndc[0].y) * error.x + std::abs(place.texel_from_ndc[1].y) * error.y);
  look.snap = kSnapTexels + off;
  constexpr double kMostSnap = 0.25;
  if (!(look.snap < kMostSnap)) return false;
  const double reach = reach_texels + look.snap;
  look.texels = {place.texel - reach, place.texel + reach};
  if (glm::any(glm::lessThan(look.texels.low, glm::dvec2(0.0))) ||
      glm::any(glm::greaterThan(look.texels.high, grid.size())))
    return false;
  const ShapeRectangle ndc =
      map_.shape->ndc_bounds(map_.shape_parameters, grid.size(), {look.texels.low, look.texels.high});
  look.ndc = {ndc.low, ndc.high};
  return true;
}

std::vector<std::uint32_t> MapSpace::near(const Rectangle& ndc) const {
  std::vector<std::uint32_t> found;
  for (std::uint32_t i = 0; i < shapes_.size(); ++i) {
    const Shape3& s = shapes_[i];
    if (!triangles_[i].casts) continue;
    if (s.low.x <= ndc.high.x && s.high.x >= ndc.low.x && s.low.y <= ndc.high.y && s.high.y >= ndc.low.y)
      found.push_back(i);
  }
  return found;
}

void MapSpace::part(std::uint32_t triangle, const Receiver3& r, const Rectangle& ndc, Polygon& out) const {
  out.clear();
  for (std::size_t c = 0; c < 3; ++c)
    out.push_back({shapes_[triangle].clip[c], glm::dot(r.normal, triangles_[triangle].corner[c] - r.point)});
  // Before the light's plane, and within the four sides.
  const std::array<glm::dvec4, 5> planes{glm::dvec4(0, 0, 0, 1),
                                         {1, 0, 0, -ndc.low.x},
                                         {-1, 0, 0, ndc.high.x},
                                         {0, 1, 0, -ndc.low.y},
                                         {0, -1, 0, ndc.high.y}};
  Polygon cut;
  for (const glm::dvec4& plane : planes) {
    cut.clear();
    for (std::size_t i = 0; i < out.size(); ++i) {
      const Corner &a = out[i], &b = out[(i + 1) % out.size()];
      const double da = glm::dot(plane, a.clip), db = glm::dot(plane, b.clip);
      if (da >= 0.0) cut.push_back(a);
      if ((da >= 0.0) == (db >= 0.0)) continue;
      const double t = da / (da - db);
      cut.push_back({a.clip + (b.clip - a.clip) * t, a.height + (b.height - a.height) * t});
    }
    out.swap(cut);
    if (out.empty()) return;
  }
}

double MapSpace::depth_rounding(const Receiver3& r, const Look& look, bool linear) const {
  const double along = std::abs(ndc_depth_per_world_unit(map_.clip_from_world, look.travel, r.point + eye_));
  const double ndc = kRoundings * kFloatStep *
                     (depth_unit_ + (row_terms(2) + std::abs(look.ndc_point.z) * row_terms(3)) / look.w);
  double world = along > 0.0 ? ndc / along : kInfinite;
  // Even depths round over all of the range alike, however near the light.
  if (linear) world = std::max(world, kRoundings * kFloatStep * map_.depth_range_world);
  return world * look.cosine + r.height_error;
}

bool MapSpace::covers(std::uint32_t triangle, const Receiver3& r, const Rectangle& ndc,
                      double least_height) const {
  Polygon polygon;
  part(triangle, r, ndc, polygon);
  if (polygon.size() < 3) return false;
  double area = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Corner &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    if (!(a.clip.w > 0.0) || !(a.height > least_height)) return false;
    area += a.clip.x / a.clip.w * (b.clip.y / b.clip.w) - b.clip.x / b.clip.w * (a.clip.y / a.clip.w);
  }
  const glm::dvec2 side = ndc.high - ndc.low;
  constexpr double kWhole = 1.0 - 1e-6;
  return 0.5 * std::abs(area) >= kWhole * side.x * side.y;
}

/// True where the answer is for a square round each texel's centre in the look-up's rectangle.
template <class Answer>
bool MapSpace::all_centres(const Look& look, const Answer& answer) const {
  const glm::dvec2 size(map_.width, map_.height);
  const glm::dvec2 first = glm::floor(look.texels.low), last = glm::ceil(look.texels.high);
  int count = 0;
  for (double y = first.y; y < last.y; y += 1.0) {
    for (double x = first.x; x < last.x; x += 1.0) {
      const glm::dvec2 centre{x + 0.5, y + 0.5};
      const ShapeRectangle ndc =
          map_.shape->ndc_bounds(map_.shape_parameters, size, {centre - look.snap, centre + look.snap});
      if (!answer(Rectangle{ndc.low, ndc.high})) return false;
      ++count;
    }
  }
  return count > 0;
}

bool MapSpace::all_centres_dark(const Receiver3& r, const Look& look,
                                const std::vector<std::uint32_t>& candidates, double height) const {
  return all_centres(look, [&](const Rectangle& square) {
    return std::any_of(candidates.begin(), candidates.end(),
                       [&](std::uint32_t t) { return covers(t, r, square, height); });
  });
}

double MapSpace::moved_by_offset(const Receiver3& r, const BiasOptions& bias) const {
  const glm::dvec3 point = r.point + eye_;
  const glm::dvec2 extent =
      texel_extent_world(map_.clip_from_world, map_.texels(), travel_at(light_, point), point);
  const double texels =
      bias.normal_offset_texels * std::max(extent.x, extent.y) / std::min(extent.x, extent.y);
  return std::isfinite(texels) ? texels : kInfinite;
}

Must MapSpace::decide(const Receiver3& r, const Comparing& comparing) const {
  const BiasOptions& bias = comparing.bias;
  Look look;
  const double moved = moved_by_offset(r, bias);
  if (!look_at(r, comparing.reach_texels + moved, look)) return Must::undecided;

  const double most = std::max(look.texel_world.x, look.texel_world.y);
  const double tangent = look.sine / look.cosine, capped = std::min(tangent, bias.max_slope);
  const double rounding = depth_rounding(r, look, comparing.linear_depth);
  const double reach_world = comparing.reach_texels * most;
  const double plane_off = r.normal_error * reach_world / look.cosine + 2.0 * look.snap * most * look.sine;
  const double offset = bias.normal_offset_texels * most * look.sine;
  const double least_lift = bias.constant_texels * most * look.cosine;
  const double most_lift =
      (bias.constant_texels + 2.0 * bias.slope_texels * capped) * most * look.cosine + offset;

  const std::vector<std::uint32_t> candidates = near(look.ndc);
  Polygon polygon;
  bool clear = least_lift >= 2.0 * (rounding + plane_off);
  std::vector<std::uint32_t> before;
  for (const std::uint32_t t : candidates) {
    if (t == r.triangle) continue;
    part(t, r, look.ndc, polygon);
    if (triangles_[t].flat) {
      clear = clear && polygon.empty();
      continue;
    }
    double highest = -kInfinite;
    for (const Corner& c : polygon) highest = std::max(highest, c.height);
    constexpr double kCoplanar = 1e-9;
    clear = clear && highest <= kCoplanar * (1.0 + largest(r.point));
    if (highest > most_lift && !triangles_[t].masked) before.push_back(t);
  }
  if (clear) return Must::lit;
  const double height = 2.0 * (most_lift + rounding + plane_off);
  return !before.empty() && all_centres_dark(r, look, before, height) ? Must::dark : Must::undecided;
}

Must MapSpace::decide_even(const Receiver3& r, const Comparing& comparing, double contact) const {
  Look look;
  if (map_.light_world.w != 0.0 || map_.kappa != 0.0 || !look_at(r, comparing.reach_texels, look))
    return Must::undecided;
  constexpr double kParallel = 1e-6;
  if (!(look.sine < kParallel)) return Must::undecided;
  const double reach_world = comparing.reach_texels * std::max(look.texel_world.x, look.texel_world.y);
  const double even = kParallel * (map_.depth_range_world + reach_world);
  // The nearest of those that cover all of it, and the highest part of any other.
  double nearest = 0.0, highest = -kInfinite;
  Polygon polygon;
  for (const std::uint32_t t : near(look.ndc)) {
    part(t, r, look.ndc, polygon);
    if (polygon.empty()) continue;
    if (triangles_[t].flat) return Must::undecided;
    double low = kInfinite, high = -kInfinite;
    for (const Corner& c : polygon) {
      low = std::min(low, c.height);
      high = std::max(high, c.height);
    }
    const bool whole =
        !triangles_[t].masked && high - low <= even && covers(t, r, look.ndc, -kInfinite) && low >= -even;
    if (whole && high > nearest - even) nearest = std::max(nearest, high);
    if (!whole) highest = std::max(highest, high);
  }
  const WorldTriangle& seen = triangles_[r.triangle];
  const bool own = covers(r.triangle, r, look.ndc, -kInfinite) && !seen.masked && seen.casts;
  if (highest > nearest + even) return Must::undecided;
  if (nearest <= even) return own ? Must::lit : Must::undecided;
  constexpr double kRoom = 1.05;
  return nearest > kRoom * contact * map_.depth_range_world + 4.0 * even ? Must::dark : Must::undecided;
}

Must MapSpace::decide_identifier(const Receiver3& r, const Comparing& comparing, bool by_triangle) const {
  Look look;
  if (!look_at(r, comparing.reach_texels + moved_by_offset(r, comparing.bias), look)) return Must::undecided;
  const double most = std::max(look.texel_world.x, look.texel_world.y);
  const double rounding = 2.0 * (depth_rounding(r, look, false) + 2.0 * look.snap * most * look.sine);
  const WorldTriangle& own = triangles_[r.triangle];
  bool others_behind = true, own_behind = true;
  std::vector<std::uint32_t> before;
  Polygon polygon;
  for (const std::uint32_t t : near(look.ndc)) {
    if (t == r.triangle) continue;
    part(t, r, look.ndc, polygon);
    if (polygon.empty()) continue;
    if (triangles_[t].flat) return Must::undecided;
    double highest = -kInfinite;
    for (const Corner& c : polygon) highest = std::max(highest, c.height);
    const bool same = !by_triangle && triangles_[t].instance == own.instance;
    if (same) own_behind = own_behind && highest <= 0.25 * rounding;
    if (!same) others_behind = others_behind && highest < -rounding;
    if (!same && highest > rounding && !triangles_[t].masked) before.push_back(t);
  }
  if (others_behind && !own.masked &&
      all_centres(look, [&](const Rectangle& square) { return covers(r.triangle, r, square, -kInfinite); }))
    return Must::lit;
  return own_behind && !before.empty() && all_centres_dark(r, look, before, rounding) ? Must::dark
                                                                                      : Must::undecided;
}

}  // namespace gnomon::stress
