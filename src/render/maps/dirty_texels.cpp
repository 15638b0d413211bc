// Which rectangles of a map could a moved caster have changed?
#include "maps/dirty_texels.hpp"
#include "gnomon/extend/body.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/mat4x3.hpp>
#include <glm/vec4.hpp>

namespace gnomon::render {
namespace {

enum class Reach : std::uint8_t { none, part, all };

/// How far rounding reaches: in texels, by the steps of a rasterizer, and as a share of the terms that make
/// up a place.
constexpr double kRoom = 1.0 / 16.0, kRounding = 1e-6;

/// The image of a box: its corners, texels from the map's lower left corner.
struct Image {
  std::array<glm::dvec2, 8> corner;
  glm::dvec2 room{0.0};
};

glm::dvec3 corner_of(const Box& box, int corner) noexcept {
  return {(corner & 1) != 0 ? box.max.x : box.min.x, (corner & 2) != 0 ? box.max.y : box.min.y,
          (corner & 4) != 0 ? box.max.z : box.min.z};
}

Reach image_of(const ShadowMap& map, const Box& box, Image& out) noexcept {
  if (box.empty()) return Reach::none;
  bool behind = false, before = false;
  const glm::dvec2 size(map.width, map.height);
  const glm::dmat4& m = map.clip_from_world;
  std::array<bool, 4> beyond;  // one of the map's sides, all corners
  beyond.fill(true);
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec4 at(corner_of(box, corner), 1.0);
    const glm::dvec4 clip = m * at;
    (clip.w > 0.0 ? before : behind) = true;
    glm::dvec2 terms(0.0);
    for (int i = 0; i < 4; ++i) terms += glm::abs(glm::dvec2(m[i]) * at[i]);
    const glm::dvec2 room = kRoom + kRounding * terms / std::abs(clip.w) * size;
    const glm::dvec2 sides = 1.0 + 2.0 * room / size;
    const glm::dvec2 low_side = sides * clip.w + glm::dvec2(clip),
                     high_side = sides * clip.w - glm::dvec2(clip);
    const std::array<bool, 4> out_of{low_side.x < 0.0, high_side.x < 0.0, low_side.y < 0.0,
                                     high_side.y < 0.0};
    for (std::size_t side = 0; side < 4; ++side) beyond[side] = beyond[side] && out_of[side];
    out.corner[static_cast<std::size_t>(corner)] = (glm::dvec2(clip) / clip.w * 0.5 + 0.5) * size;
    out.room = glm::max(out.room, room);
  }
  if (!before || std::find(beyond.begin(), beyond.end(), true) != beyond.end()) return Reach::none;
  if (behind || !map.shape->affine) return Reach::all;
  return Reach::part;
}

/// The texels of a map whose centres lie between two corners; empty where there are none.
TexelRect texels_between(const glm::dvec2& low, const glm::dvec2& high, const glm::dvec2& size) noexcept {
  const glm::dvec2 from = glm::max(glm::ceil(low - 0.5), glm::dvec2(0.0)),
                   to = glm::min(glm::floor(high - 0.5) + 1.0, size);
  if (!(to.x > from.x && to.y > from.y)) return {};
  return {static_cast<int>(from.x), static_cast<int>(from.y), static_cast<int>(to.x - from.x),
          static_cast<int>(to.y - from.y)};
}

TexelRect bounds_of(const Image& image, const glm::dvec2& size) noexcept {
  glm::dvec2 low = image.corner[0], high = low;
  for (const glm::dvec2& corner : image.corner) {
    low = glm::min(low, corner);
    high = glm::max(high, corner);
  }
  return texels_between(low - image.room, high + image.room, size);
}

double area(const TexelRect& r) noexcept {
  return 1.0 * r.width * r.height;
}

/// Texels that joining two of them draws besides.
double waste(const TexelRect& a, const TexelRect& b) noexcept {
  return area(joined(a, b)) - area(a) - area(b);
}

/// Joins rectangles that overlap or lie close, and the two that waste least where there are too many.
void add(const TexelRect& image, DirtyTexels& out) noexcept {
  TexelRect added = image;
  for (std::size_t i = 0; i < out.count;) {
    if (waste(added, out.rectangle[i]) > 0.0) {
      ++i;
      continue;
    }
    added = joined(added, out.rectangle[i]);
    out.rectangle[i] = out.rectangle[--out.count];
    i = 0;
  }
  if (out.count < DirtyTexels::kMost) {
    out.rectangle[out.count++] = added;
    return;
  }
  std::size_t best = 0;
  for (std::size_t i = 1; i < out.count; ++i) {
    if (waste(added, out.rectangle[i]) < waste(added, out.rectangle[best])) best = i;
  }
  const TexelRect both = joined(added, out.rectangle[best]);
  out.rectangle[best] = out.rectangle[--out.count];
  add(both, out);
}

using Edge = std::array<std::uint8_t, 2>;
constexpr std::array<Edge, 3> kTriangleEdges{{{0, 1}, {1, 2}, {2, 0}}};
/// Of a box, whose corner i has the maximum along x, y and z where bits 0, 1 and 2 of i are set.
constexpr std::array<Edge, 12> kBoxEdges{
    {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3}, {4, 6}, {5, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};

/// Texels of a map from a shape's positions.
class Projection {
 public:
  Projection(const ShadowMap& map, const glm::dmat4& world_from_object) noexcept {
    const glm::dmat4 clip_from_object = map.clip_from_world * world_from_object;
    const glm::dvec2 half = 0.5 * glm::dvec2(map.width, map.height);
    for (int i = 0; i < 4; ++i) {
      const glm::dvec4& column = clip_from_object[i];
      column_[i] = {(glm::dvec2(column) + column.w) * half, column.w};
    }
    divides_ = !(column_[0].z == 0.0 && column_[1].z == 0.0 && column_[2].z == 0.0 && column_[3].z == 1.0);
  }
  [[nodiscard]] glm::dvec2 operator()(const glm::dvec3& p) const noexcept {
    const glm::dvec3 texel = column_[0] * p.x + column_[1] * p.y + column_[2] * p.z + column_[3];
    return divides_ ? glm::dvec2(texel) / texel.z : glm::dvec2(texel);
  }

 private:
  glm::dmat4x3 column_;  ///< to x w, y w, w
  bool divides_ = true;
};

bool is_finite(std::span<const glm::dvec2> points) noexcept {
  return std::all_of(points.begin(), points.end(),
                     [](const glm::dvec2& p) { return std::isfinite(p.x) && std::isfinite(p.y); });
}

}  // namespace

DirtyTexels dirty_bounds(const ShadowMap& map, std::span<const Box> moved_world) noexcept {
  DirtyTexels out;
  for (const Box& box : moved_world) {
    Image image;
    const Reach reach = image_of(map, box, image);
    if (reach == Reach::all) {
      out.whole = true;
      out.count = 0;
      return out;
    }
    if (reach == Reach::none) continue;
    const TexelRect bounds = bounds_of(image, glm::dvec2(map.width, map.height));
    if (bounds.empty()) continue;
    add(bounds, out);
  }
  return out;
}

bool DirtyShapes::mark(TexelMask& mask, const ShadowMap& map, const CasterShape& shape,
                       std::size_t& parts_left) {
  Image image;
  const Reach reach = image_of(map, shape.bounds_world, image);
  if (reach != Reach::part) return reach == Reach::none;
  if (!is_finite(image.corner)) return false;
  image_.clear();
  if (shape.size() > 0 && shape.size() <= parts_left) {
    parts_left -= shape.size();
    const Projection texel_of(map, shape.world_from_object);
    if (shape.parts.empty())
      for (const glm::vec3& position : shape.positions) image_.push_back(texel_of(glm::dvec3(position)));
    for (const Box& part : shape.parts)
      for (int corner = 0; corner < 8; ++corner) image_.push_back(texel_of(corner_of(part, corner)));
  }
  if (image_.empty() || !is_finite(image_)) {
    mask.mark(image.corner, kBoxEdges, image.room);
  } else if (shape.parts.empty()) {
    for (std::size_t i = 0; i + 2 < shape.indices.size(); i += 3) {
      const std::array<glm::dvec2, 3> triangle{image_[shape.indices[i]], image_[shape.indices[i + 1]],
                                               image_[shape.indices[i + 2]]};
      mask.mark(triangle, kTriangleEdges, image.room);
    }
  } else {
    for (std::size_t i = 0; i < image_.size(); i += 8)
      mask.mark(std::span(image_).subspan(i, 8), kBoxEdges, image.room);
  }
  return true;
}

bool DirtyShapes::mark_all(const ShadowMap& map, std::span<const Box> named_world,
                           std::span<const MovedCaster> moved) {
  dirty_.reset(map.width, map.height);
  std::size_t no_parts = 0, parts_left = kMaxParts;
  for (const Box& box : named_world) {
    CasterShape bounds;
    bounds.bounds_world = box;
    if (!mark(dirty_, map, bounds, no_parts)) return false;
  }
  // Where they stand holds no more than where those stood that moved.
  std::swap(stands_, stood_);
  const bool all_moved = std::includes(moved_.begin(), moved_.end(), standing_.begin(), standing_.end());
  const bool knows = remembers_ && all_moved && stood_.is_of(map.width, map.height);
  if (knows) dirty_.mark(stood_);
  for (const MovedCaster& caster : moved) {
    if (knows && std::binary_search(standing_.begin(), standing_.end(), caster.instance)) continue;
    if (!mark(dirty_, map, caster.from, parts_left)) return false;
  }
  stands_.reset(map.width, map.height);
  parts_left = kMaxParts;
  for (const MovedCaster& caster : moved)
    if (!mark(stands_, map, caster.to, parts_left)) return false;
  dirty_.mark(stands_);
  return true;
}

bool DirtyShapes::find(const ShadowMap& map, std::span<const Box> named_world,
                       std::span<const MovedCaster> moved) {
  rectangles_ = {};
  moved_.clear();
  for (const MovedCaster& caster : moved) moved_.push_back(caster.instance);
  std::sort(moved_.begin(), moved_.end());
  remembers_ = mark_all(map, named_world, moved);
  std::swap(standing_, moved_);
  if (remembers_) rectangles_ = dirty_.rectangles(kMost);
  return remembers_;
}

bool may_touch(const ShadowMap& map, const Box& box, std::span<const TexelRect> rectangles) noexcept {
  Image image;
  const Reach reach = image_of(map, box, image);
  if (reach != Reach::part) return reach == Reach::all && !rectangles.empty();
  const TexelRect b = bounds_of(image, glm::dvec2(map.width, map.height));
  return std::any_of(rectangles.begin(), rectangles.end(), [&b](const TexelRect& r) {
    return b.x < r.x + r.width && r.x < b.x + b.width && b.y < r.y + r.height && r.y < b.y + b.height;
  });
}

}  // namespace gnomon::render
